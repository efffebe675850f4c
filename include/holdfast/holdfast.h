#ifndef HOLDFAST_HOLDFAST_H
#define HOLDFAST_HOLDFAST_H

/* holdfast: what becomes of a container loading when the container brakes, corners or changes lane. C11.
 *
 * This is the library of holdfast.hpp for C, and for every language that can call C. A screen is made once from
 * settings and accelerations, and then evaluates layouts, thousands of times: arrays in, outcomes out. It gives the
 * same bits as `holdfast screen` does on the same layouts, whatever the number of threads, the batch and the order.
 *
 *     const double brake[] = {0.5, 1.0, 7.848, 0.0, 0.0};
 *     const double boxes[] = {2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1.0};
 *     const size_t offsets[] = {0, 1};
 *     const holdfast_layouts layouts = {
 *         .size = sizeof layouts, .boxes = boxes, .box_count = 1, .offsets = offsets, .layout_count = 1};
 *     holdfast_outcome outcome = {.size = sizeof outcome};
 *     holdfast_screen* screen;
 *     if (holdfast_screen_new(NULL, NULL, &screen) != HOLDFAST_OK ||
 *         holdfast_screen_add_acceleration(screen, "brake", brake, 1) != HOLDFAST_OK ||
 *         holdfast_screen_evaluate(screen, &layouts, &outcome, 1) != HOLDFAST_OK)
 *       fprintf(stderr, "%s\n", holdfast_screen_message(screen));
 *     else if (outcome.verdict != HOLDFAST_STAYED)
 *       reject();
 *     holdfast_screen_free(screen);
 *
 * Frame: that of the container, right-handed; x along its length from the front wall to the door, y across, z up; the
 * origin is the lower corner at the front wall with the smallest coordinates. SI units throughout, unless stated.
 *
 * Boxes are rows of seven numbers: x, y, z of the corner with the smallest coordinates, x, y, z of that with the
 * largest, and the material, a whole number from 0. Segments of an acceleration are rows of five: start (s), duration
 * (s), and the acceleration of the container along x, y, z (m/s²; a vehicle that brakes has +x).
 *
 * Objects. `_new` makes one, `_free` ends it, and takes NULL too. A function that is given what is no living object of
 * its kind, such as one that was freed, does nothing and returns HOLDFAST_BAD_HANDLE. One thread at a time uses an
 * object; a second one meanwhile gets HOLDFAST_IN_USE, apart from `_cancel` and `_free`, which any thread may call.
 * Different objects are independent of each other. Objects that are left at exit are freed then. In a process
 * that was forked, a screen of the parent has nothing in flight, and works on one thread, if the parent has used
 * several.
 *
 * Errors. Functions return a status code and throw nothing. The object keeps a message, and a screen every problem in
 * its parts. Texts belong to the object, and are valid until the next call on it. Text is UTF-8 and ends with a zero
 * byte.
 *
 * Arrays are those of the caller, and are read or written during the call only. Structures begin with their size, which
 * the caller sets, in an array that of the first entry for all: a later version of the library may know more members.
 * Those that the library reads are set to zero beyond it for defaults. Of those that it fills it writes what both know.
 *
 * Compatibility: as for holdfast.hpp. A minor version may add to what is declared here, and changes nothing of it. */

#include <holdfast/outcome_fields.h>
#include <stddef.h>
#include <stdint.h>

/* Version of this header, for the preprocessor: 10000 * major + 100 * minor + patch. */
#define HOLDFAST_VERSION 20000

#if defined(__GNUC__)
#define HOLDFAST_API __attribute__((visibility("default")))
#else
#define HOLDFAST_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What functions return. */
enum {
  HOLDFAST_OK = 0,
  HOLDFAST_ERROR = 1, /* an input cannot be used, a file cannot be written, memory has run out: see the message */
  HOLDFAST_BAD_ARGUMENT = 2, /* the calling program is wrong, such as by NULL or a short array: see the message */
  HOLDFAST_BAD_HANDLE = 3,   /* no living object of that kind: never made, freed already, or NULL */
  HOLDFAST_IN_USE = 4,       /* another thread uses the object */
  HOLDFAST_CANCELLED = 5,    /* holdfast_screen_cancel has ended the call before it was done */
  HOLDFAST_FULL = 6,         /* so many layouts are in flight that one must be polled before */
  HOLDFAST_NOT_YET = 7,      /* none of the layouts in flight is finished */
  HOLDFAST_NONE = 8          /* no layout is in flight */
};

/* Version of the library that is linked, such as "2.0.0". May be called from any thread. */
HOLDFAST_API const char* holdfast_version(void);

/* ---- Settings: keys of config.ini and their values, see docs/reference/config.md. ---- */

typedef struct holdfast_settings holdfast_settings;

/* Settings that are all at their defaults; NULL when memory has run out. */
HOLDFAST_API holdfast_settings* holdfast_settings_new(void);
HOLDFAST_API void holdfast_settings_free(holdfast_settings* settings);

/* Sets the keys that the text of a config.ini gives. With an error nothing is set. */
HOLDFAST_API int holdfast_settings_read(holdfast_settings* settings, const char* text);

/* Sets one key, such as ("Native", "Accuracy", "screening") or ("Material 3", "Density", "300"). Keys that contradict
 * each other are an error when a screen or a world is made. */
HOLDFAST_API int holdfast_settings_set(holdfast_settings* settings, const char* section, const char* key,
                                       const char* value);

/* Why the last call failed; "" when it did not. Never NULL. */
HOLDFAST_API const char* holdfast_settings_message(const holdfast_settings* settings);

/* ---- Screens: evaluate layouts under accelerations. ---- */

typedef struct holdfast_screen holdfast_screen;

/* Unit of the lengths of layouts. */
enum { HOLDFAST_METRE = 0, HOLDFAST_CENTIMETRE = 1 };

/* How a screen works. */
typedef struct holdfast_screen_options {
  size_t size;              /* sizeof(holdfast_screen_options) */
  const char* engine;       /* such as "native"; NULL: as the settings say */
  const char* accuracy;     /* of the native engine: "screening", "standard", "reference"; NULL: as the settings say */
  const char* scheduler;    /* "tbb", "openmp" or "serial", never changes a result; NULL: as the settings say */
  int32_t threads;          /* worlds that are simulated at the same time; 0: as the settings say, or one per core */
  int32_t unit;             /* of the corners of boxes: HOLDFAST_METRE, HOLDFAST_CENTIMETRE */
  int32_t mark_bad_layouts; /* 0: a bad layout is an error; 1: its worlds have HOLDFAST_BAD_LAYOUT */
  int32_t keep_boxes;       /* 1: holdfast_screen_boxes gives the boxes */
  size_t most_in_flight;    /* layouts that holdfast_screen_submit takes before one is polled; 0: 16 per thread */
  const char* norm; /* norm whose accelerations the screen begins with, such as "road", see docs/reference/norms.md;
                       "": none; NULL: as the settings say */
} holdfast_screen_options;

/* Makes a screen, which starts no thread before it needs one.
 * settings: NULL for defaults; may be changed or freed afterwards
 * options:  NULL for defaults
 * screen:   set to the new screen. After HOLDFAST_ERROR and HOLDFAST_BAD_ARGUMENT it can only tell its message and
 *           errors, and be freed; it is NULL after HOLDFAST_BAD_HANDLE, and when memory has run out */
HOLDFAST_API int holdfast_screen_new(const holdfast_settings* settings, const holdfast_screen_options* options,
                                     holdfast_screen** screen);

/* Cancels what the screen does, and frees it when that has ended. */
HOLDFAST_API void holdfast_screen_free(holdfast_screen* screen);

/* Adds an acceleration: segments by rising time, without overlap. Not while layouts are in flight.
 * name:     labels results and messages; NULL: "acceleration" and its index
 * segments: rows of five numbers */
HOLDFAST_API int holdfast_screen_add_acceleration(holdfast_screen* screen, const char* name, const double* segments,
                                                  size_t segment_count);

/* Number of accelerations: those of the norm and those that were added. 0 for what is no screen. */
HOLDFAST_API size_t holdfast_screen_acceleration_count(const holdfast_screen* screen);

/* Layouts: that with index i consists of the boxes offsets[i], ..., offsets[i + 1] - 1. Boxes may touch; they overlap
 * each other, or protrude from the container, by 0.1 mm at most. */
typedef struct holdfast_layouts {
  size_t size;           /* sizeof(holdfast_layouts) */
  const double* boxes;   /* rows of seven numbers, of all layouts */
  size_t box_count;      /* number of rows */
  const size_t* offsets; /* layout_count + 1 numbers that do not fall, box_count at most */
  size_t layout_count;
  const char* const* names; /* one per layout, label results and messages; NULL, also of one: "layout" and its index */
  const double* masses;     /* kg, one per row; not a number: by the material of the box; NULL: all of them */
  const double* mats;       /* coefficients of friction of anti-slip mats beneath boxes, on whatever these stand on, one
                               per row; not a number: none; NULL: all of them */
  const char* const* box_names;  /* one per row, shown in messages; NULL, also of one: its number */
  const char* const* containers; /* types of containers, such as "40hc", one per layout; NULL, also of one: that of the
                                    settings */
} holdfast_layouts;

/* The names and members below are made of the rows of outcome_fields.h, which say what each one means. */
#define HOLDFAST_C_NAME(name, c_name, code, sentence) HOLDFAST_##c_name = (code),
#define HOLDFAST_C_u32(name) uint32_t name;
#define HOLDFAST_C_u64(name) uint64_t name;
#define HOLDFAST_C_hash(name) uint64_t name;
#define HOLDFAST_C_f32(name) float name;
#define HOLDFAST_C_f64(name) double name;
#define HOLDFAST_C_time(name) double name;
#define HOLDFAST_C_vec3(name) float name[3];
#define HOLDFAST_C_flag(name) uint8_t name;
#define HOLDFAST_C_status(name) uint32_t name;
#define HOLDFAST_C_caveat(name) uint32_t name;
#define HOLDFAST_C_verdict(name) int32_t name;
#define HOLDFAST_C_stop_reason(name) int32_t name;
#define HOLDFAST_C_MEMBER(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_C_##scope(HOLDFAST_C_##type(name))

/* What became of a world as a whole, by the worst that happened in it: HOLDFAST_STAYED, ... of HOLDFAST_VERDICTS. */
enum { HOLDFAST_VERDICTS(HOLDFAST_C_NAME) };

/* Bits of a status, what went wrong with a world: HOLDFAST_BAD_LAYOUT, ... of HOLDFAST_STATUS_BITS. */
enum { HOLDFAST_STATUS_BITS(HOLDFAST_C_NAME) };

/* Bits of what has to be known beside the verdict: HOLDFAST_NOT_AT_REST, ... of HOLDFAST_CAVEAT_BITS. */
enum { HOLDFAST_CAVEAT_BITS(HOLDFAST_C_NAME) };

/* Why a world ended: HOLDFAST_NOT_RUN, ... of HOLDFAST_STOP_REASONS. */
enum { HOLDFAST_STOP_REASONS(HOLDFAST_C_NAME) };

/* What became of a world, one layout under one acceleration: HOLDFAST_WORLD_FIELDS. `layout` is an index into the
 * layouts of the call, or the ticket of a layout that was submitted; `acceleration` one into those of the screen. In a
 * world that was not simulated, counts and measures are 0. */
typedef struct holdfast_outcome {
  size_t size; /* sizeof(holdfast_outcome) */
  HOLDFAST_WORLD_FIELDS(HOLDFAST_C_MEMBER)
} holdfast_outcome;

/* Evaluates every layout under every acceleration, and returns when all are done.
 * outcomes: set to those of all worlds, layout by layout, acceleration fastest
 * capacity: number of outcomes that the array has room for: at least layouts times accelerations
 * Returns HOLDFAST_CANCELLED when holdfast_screen_cancel ended it: the worlds that were lost have HOLDFAST_NOT_RUN. */
HOLDFAST_API int holdfast_screen_evaluate(holdfast_screen* screen, const holdfast_layouts* layouts,
                                          holdfast_outcome* outcomes, size_t capacity);

/* Tells of every layout whether it stays under every acceleration, all of its worlds being HOLDFAST_STAYED: the answer
 * of holdfast_screen_evaluate, sooner, since a world ends when its verdict is decided, and a layout with the first
 * world that rejects it.
 * holds:    set to 1 or 0, one per layout; 0 too for a layout that cannot be used, and after holdfast_screen_cancel
 * capacity: number of layouts that the array has room for
 * Returns HOLDFAST_CANCELLED when holdfast_screen_cancel ended it. */
HOLDFAST_API int holdfast_screen_holds(holdfast_screen* screen, const holdfast_layouts* layouts, uint8_t* holds,
                                       size_t capacity);

/* Hands one layout over, and returns while it is evaluated on threads of the screen.
 * ticket: set to the number by which holdfast_screen_poll names the layout; may be NULL
 * Returns HOLDFAST_FULL, and takes no layout, when the options' most_in_flight are in flight. */
HOLDFAST_API int holdfast_screen_submit(holdfast_screen* screen, const double* boxes, size_t box_count,
                                        uint64_t* ticket);

/* The same of a layout that has more than rows of numbers.
 * layout: one layout; its name is not used
 * ticket: as of holdfast_screen_submit */
HOLDFAST_API int holdfast_screen_submit_layout(holdfast_screen* screen, const holdfast_layouts* layout,
                                               uint64_t* ticket);

/* Gives back a layout that was handed over and is finished.
 * seconds:  how long to wait for one, at most
 * in_order: 0: the one that was finished first; 1: the one that was handed over first, once it is finished
 * ticket:   set to that of the layout; may be NULL
 * outcomes: set to one per acceleration; those of worlds that were cancelled have HOLDFAST_NOT_RUN
 * capacity: number of outcomes that the array has room for
 * Returns HOLDFAST_NOT_YET when none was finished in time, HOLDFAST_NONE when none is in flight. */
HOLDFAST_API int holdfast_screen_poll(holdfast_screen* screen, double seconds, int in_order, uint64_t* ticket,
                                      holdfast_outcome* outcomes, size_t capacity);

/* Why the status of an outcome is not 0, and what to do; "" when it is 0.
 * index: into the outcomes of the last call of holdfast_screen_evaluate or holdfast_screen_poll */
HOLDFAST_API const char* holdfast_screen_outcome_message(const holdfast_screen* screen, size_t index);

/* What became of one box: HOLDFAST_BOX_FIELDS and HOLDFAST_BOX_VERDICT_FIELDS. */
typedef struct holdfast_box_outcome {
  size_t size; /* sizeof(holdfast_box_outcome) */
  HOLDFAST_BOX_FIELDS(HOLDFAST_C_MEMBER)
  HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_C_MEMBER)
} holdfast_box_outcome;

/* How the boxes of a world ended, with the option keep_boxes.
 * index:    as in holdfast_screen_outcome_message
 * boxes:    set to one per box, in the order of the layout
 * capacity: number of boxes that the array has room for: at least the outcome's `boxes` */
HOLDFAST_API int holdfast_screen_boxes(holdfast_screen* screen, size_t index, holdfast_box_outcome* boxes,
                                       size_t capacity);

/* What the replicas of a world say of it: HOLDFAST_REPLICAS_NONE, ... of HOLDFAST_REPLICA_VERDICTS. */
enum { HOLDFAST_REPLICA_VERDICTS(HOLDFAST_C_NAME) };

/* What became of the replicas of a world, see docs/guide/confidence.md. */
typedef struct holdfast_replicas {
  size_t size;       /* sizeof(holdfast_replicas) */
  int32_t verdict;   /* HOLDFAST_REPLICAS_NONE, ... */
  uint32_t count;    /* of the replicas whose end is known */
  uint32_t failed;   /* of these, those in which a box fell, moved or tilted, or was unstable */
  double share;      /* failed / count; not a number without replicas, as the next two */
  double wilson_low; /* ends of the interval in which the share is at 95 % */
  double wilson_high;
  double cpu_seconds; /* processor time for all of them, s */
} holdfast_replicas;

/* What became of the replicas of a world; settings with [Screening] Replicas ask for them.
 * index:    into the outcomes of the last call of holdfast_screen_evaluate or holdfast_screen_poll
 * replicas: set to it */
HOLDFAST_API int holdfast_screen_replicas(holdfast_screen* screen, size_t index, holdfast_replicas* replicas);

/* What impacts did to the boxes of a world, see docs/guide/damage.md. */
typedef struct holdfast_damage {
  size_t size;             /* sizeof(holdfast_damage) */
  uint32_t boxes_beyond;   /* boxes beyond the damage boundary */
  float peak_acceleration; /* largest of all boxes, mean over DamageWindow, m/s2 */
  float velocity_change;   /* largest of all boxes in an impact, m/s */
} holdfast_damage;

/* What impacts did to the boxes of a world; settings with [Screening] Damage ask for it.
 * index:  into the outcomes of the last call of holdfast_screen_evaluate or holdfast_screen_poll
 * damage: set to it
 * HOLDFAST_BAD_ARGUMENT also where it was not asked for, or the world was not accelerated. */
HOLDFAST_API int holdfast_screen_damage(holdfast_screen* screen, size_t index, holdfast_damage* damage);

/* A number that an analysis of [Screening] finds of a world, such as "boxes_beyond" or "load_shift": those of
 * `analysis_numbers` of holdfast.hpp, by their names. What was not asked for is not a number, or 0.
 * index:  into the outcomes of the last call of holdfast_screen_evaluate or holdfast_screen_poll
 * number: set to it
 * HOLDFAST_BAD_ARGUMENT also where no analysis has a number of that name. */
HOLDFAST_API int holdfast_screen_number(holdfast_screen* screen, size_t index, const char* name, double* number);

/* How many g a layout stands, see docs/guide/margins.md. Entries are for the load pushed to the front, the rear, the
 * left and the right. A critical box is a position in the layout, from 1; 0: none goes beyond up to 1.5 g. */
typedef struct holdfast_margins {
  size_t size;              /* sizeof(holdfast_margins) */
  double margin[4];         /* largest constant acceleration, for as long as anything moves, under which every box stays
                               in its place, within 5 mm, g, up to 1.5; negative: the layout is unstable under gravity
                               alone; not a number: the layout cannot be used, or the call was cancelled before */
  uint32_t critical_box[4]; /* the box that leaves its place first above the margin */
  double margin_within_limits[4];         /* the same where every box stays within the limits of the verdict */
  uint32_t critical_box_within_limits[4]; /* the box that is beyond a limit first above that margin */
  uint32_t trials;                        /* accelerations that were tried */
  double cpu_seconds;                     /* processor time, s */
} holdfast_margins;

/* How many g every layout stands. The accelerations of the screen play no part, and there need not be any.
 * margins:  set to one per layout
 * capacity: number of layouts that the array has room for
 * Returns HOLDFAST_CANCELLED when holdfast_screen_cancel ended it.
 * HOLDFAST_ERROR also when the engine cannot find margins; native can. */
HOLDFAST_API int holdfast_screen_margins(holdfast_screen* screen, const holdfast_layouts* layouts,
                                         holdfast_margins* margins, size_t capacity);

/* How holdfast_screen_record treats its file. */
typedef struct holdfast_record_options {
  size_t size;              /* sizeof(holdfast_record_options) */
  int32_t no_series;        /* 1: without time series */
  int32_t resume;           /* 1: continue a run of the same layouts that was stopped or killed */
  int32_t overwrite;        /* 1: replace the results of an earlier run; not together with resume */
  const char* command_line; /* noted in the file; may be NULL */
} holdfast_record_options;

/* Evaluates every layout under every acceleration into a results file, as `holdfast screen` writes it. What is finished
 * survives whatever ends the process.
 * options: NULL for defaults
 * HOLDFAST_ERROR also when the file exists and options do not say what to do with it.
 * Returns HOLDFAST_CANCELLED when holdfast_screen_cancel ended it: the finished worlds are kept for `resume`. */
HOLDFAST_API int holdfast_screen_record(holdfast_screen* screen, const holdfast_layouts* layouts, const char* path,
                                        const holdfast_record_options* options);

/* Ends the running call early, and all layouts in flight. Any thread may call it; it does nothing where nothing runs.
 */
HOLDFAST_API int holdfast_screen_cancel(holdfast_screen* screen);

/* Why the last call failed; "" when it did not. Never NULL. */
HOLDFAST_API const char* holdfast_screen_message(const holdfast_screen* screen);

/* One thing that is wrong with an input. Text that does not apply is "", a place in a text 0, an index -1. */
typedef struct holdfast_problem {
  size_t size;          /* sizeof(holdfast_problem) */
  const char* file;     /* path of the file, or name of the layout or acceleration */
  int64_t line;         /* in the file, from 1 */
  int64_t column;       /* in the line, from 1 */
  const char* what;     /* what is wrong */
  const char* value;    /* the offending value */
  const char* accepted; /* what would be accepted */
  const char* message;  /* all of it in one line */
  int64_t layout;       /* index into the layouts of the call */
  int64_t box;          /* index into the boxes of that layout */
  int64_t box_column;   /* index into the seven numbers of that box */
} holdfast_problem;

/* Number of problems that the last call found: at least one where it returned HOLDFAST_ERROR, and, with the option
 * mark_bad_layouts, those of the layouts that it marked. */
HOLDFAST_API size_t holdfast_screen_error_count(const holdfast_screen* screen);

/* One of them. */
HOLDFAST_API int holdfast_screen_error(const holdfast_screen* screen, size_t index, holdfast_problem* problem);

/* ---- Worlds: one layout under one acceleration, taken forward as far as the caller wants. ---- */

typedef struct holdfast_world holdfast_world;

/* Makes a world at time 0, after settling. At its end its hash is that of the same world of a screen.
 * settings: NULL for defaults; the engine is native or native-plain
 * unit:     of the corners of boxes: HOLDFAST_METRE, HOLDFAST_CENTIMETRE
 * world:    set to the new world, as holdfast_screen_new sets a screen */
HOLDFAST_API int holdfast_world_new(const holdfast_settings* settings, const double* boxes, size_t box_count, int unit,
                                    const double* segments, size_t segment_count, holdfast_world** world);

/* The same of a layout that has more than rows of numbers.
 * layout: one layout */
HOLDFAST_API int holdfast_world_new_of_layout(const holdfast_settings* settings, const holdfast_layouts* layout,
                                              int unit, const double* segments, size_t segment_count,
                                              holdfast_world** world);
HOLDFAST_API void holdfast_world_free(holdfast_world* world);

/* Takes the world forward until it has reached a time, s, or its end. A time that has passed changes nothing. */
HOLDFAST_API int holdfast_world_advance(holdfast_world* world, double time);

/* The time that was asked for last, and the time at which the world ends, s. Either pointer may be NULL. */
HOLDFAST_API int holdfast_world_times(holdfast_world* world, double* time, double* end_time);

/* Where the boxes are at that time, in the order of the layout, interpolated between the steps around it.
 * poses:    set to rows of seven numbers: x, y, z of the centre of mass (m), and the orientation as a quaternion
 *           w, x, y, z, container from body
 * capacity: number of rows that the array has room for: at least the number of boxes */
HOLDFAST_API int holdfast_world_poses(holdfast_world* world, double* poses, size_t capacity);

/* How the boxes move at that time, interpolated likewise.
 * velocities: set to rows of six numbers: x, y, z of the velocity of the centre of mass (m/s), and x, y, z of the
 *             angular velocity, container frame (rad/s)
 * capacity:   number of rows that the array has room for: at least the number of boxes */
HOLDFAST_API int holdfast_world_velocities(holdfast_world* world, double* velocities, size_t capacity);

/* The next three change what acts on the boxes from now on: from the end of the step that the time is in, or, where
 * nothing moves, from the time itself. All boxes are awake then. A number that cannot be used is HOLDFAST_ERROR, and
 * changes nothing. After the end they have no effect. */

/* Gives the container a constant acceleration in place of what is left of its segments. The end stays where it is.
 * acceleration: three numbers, container frame, m/s² */
HOLDFAST_API int holdfast_world_set_acceleration(holdfast_world* world, const double* acceleration);

/* Sets the coefficients of static friction of two boxes, of box and floor, and of box and wall or roof, whatever
 * settings and materials say; the share that is kinetic stays. HOLDFAST_ERROR also when the engine is not native. */
HOLDFAST_API int holdfast_world_set_friction(holdfast_world* world, double box_box, double box_floor, double box_wall);

/* Pushes a box with a force until it is set again; zero takes it away. A box has one force.
 * box:   index into the boxes of the layout
 * force: three numbers, container frame, N
 * point: where it acts: three numbers, container frame at this time, m; from then on it goes with the box. NULL: the
 *        centre of mass
 * HOLDFAST_ERROR also when the engine is not native. */
HOLDFAST_API int holdfast_world_set_force(holdfast_world* world, size_t box, const double* force, const double* point);

/* Forces of the boxes on the sides of the container, mean over the last step, container frame, N; before the first one,
 * of the load as it has settled.
 * forces:   set to eight rows of three numbers: floor, front, rear, left, right, roof, the ground beneath an open
 *           container, and the fixed boxes together
 * capacity: number of rows that the array has room for: at least eight
 * HOLDFAST_BAD_ARGUMENT also without the setting WallForces or Walls of [Screening]; the engine is native. */
HOLDFAST_API int holdfast_world_side_forces(holdfast_world* world, double* forces, size_t capacity);

/* Of poses and velocities at the last step end: equal bits, equal hash. */
HOLDFAST_API int holdfast_world_hash(holdfast_world* world, uint64_t* hash);

/* Why the last call failed; "" when it did not. Never NULL. */
HOLDFAST_API const char* holdfast_world_message(const holdfast_world* world);

#ifdef __cplusplus
}
#endif

#endif /* HOLDFAST_HOLDFAST_H */
