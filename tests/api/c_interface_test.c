/* The C interface as a C program sees it: compiled as C11, with pedantic warnings as errors. Prints what fails. */
#include <holdfast/holdfast.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

static void check(int good, const char* text, int line) {
  if (good) return;
  ++failures;
  fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, line, text);
}

#define CHECK(condition) check((condition) != 0, #condition, __LINE__)

enum { layout_count = 3, acceleration_count = 2, world_count = layout_count * acceleration_count };

/* Three layouts: one box in the middle of the floor, one at the front wall, and a stack of two. */
static const double kBoxes[] = {2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1.0,  /**/
                                0.0, 1.0, 0.0, 0.5, 1.5, 0.5, 1.0,  /**/
                                1.0, 1.0, 0.0, 1.5, 1.5, 0.5, 1.0,  /**/
                                1.0, 1.0, 0.5, 1.5, 1.5, 1.0, 1.0}; /**/
static const size_t kOffsets[] = {0, 1, 2, 4};
static const double kWeak[] = {0.0, 1.0, 4.8, 0.0, 0.0};
static const double kGentle[] = {0.0, 1.0, 2.0, 0.0, 0.0};
static const double kStrong[] = {0.0, 1.0, 7.0, 0.0, 0.0};

static holdfast_layouts layouts(void) {
  const holdfast_layouts all = {
      .size = sizeof all, .boxes = kBoxes, .box_count = 4, .offsets = kOffsets, .layout_count = layout_count};
  return all;
}

static holdfast_screen* screen_with(const holdfast_screen_options* options) {
  holdfast_screen* screen = NULL;
  CHECK(holdfast_screen_new(NULL, options, &screen) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, "weak", kWeak, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, kStrong, 1) == HOLDFAST_OK);
  return screen;
}

static void evaluates(void) {
  const holdfast_screen_options options = {.size = sizeof options, .keep_boxes = 1};
  holdfast_screen* screen = screen_with(&options);
  const holdfast_layouts all = layouts();
  holdfast_outcome outcomes[world_count] = {{.size = sizeof outcomes[0]}};
  holdfast_box_outcome boxes[2] = {{.size = sizeof boxes[0]}};
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_OK);
  CHECK(strcmp(holdfast_screen_message(screen), "") == 0);
  CHECK(outcomes[0].verdict == HOLDFAST_STAYED);
  CHECK(outcomes[0].stop_reason == HOLDFAST_SLEEPING);
  CHECK(outcomes[1].verdict == HOLDFAST_MOVED);
  CHECK(outcomes[1].acceleration == 1);
  CHECK(outcomes[2].boxes == 1);
  CHECK(outcomes[4].layout == 2);
  CHECK(outcomes[5].boxes == 2);
  /* Friction of 0.5 on the floor: v = 7 - 0.5 * 9.81 after 1 s, and v / 2 * (1 s + v / (0.5 * 9.81)) until it stands.
   */
  CHECK(fabs((double)outcomes[1].end_displacement - 1.0475 * (1.0 + 2.095 / 4.905)) < 2e-3);
  CHECK(outcomes[1].peak_displacement == outcomes[1].end_displacement && outcomes[1].critical_box == 1);
  CHECK(outcomes[0].caveats == 0 && isnan(outcomes[0].status_time));
  CHECK(holdfast_screen_boxes(screen, 1, boxes, 2) == HOLDFAST_OK);
  CHECK(boxes[0].moved == 1 && boxes[0].fallen == 0);
  CHECK(boxes[0].end_displacement[0] < 0.0F && boxes[0].first_beyond > 0.3F);
  CHECK(holdfast_screen_boxes(screen, world_count, boxes, 2) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_boxes(screen, 5, boxes, 1) == HOLDFAST_BAD_ARGUMENT);
  holdfast_screen_free(screen);
}

static void ends_early(void) {
  const holdfast_layouts all = layouts();
  holdfast_outcome outcomes[world_count] = {{.size = sizeof outcomes[0]}};
  holdfast_settings* settings = holdfast_settings_new();
  holdfast_screen* screen = NULL;
  CHECK(holdfast_settings_set(settings, "Screening", "StopWhen", "moved") == HOLDFAST_OK);
  CHECK(holdfast_screen_new(settings, NULL, &screen) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, "weak", kWeak, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, kStrong, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_OK);
  CHECK(outcomes[0].verdict == HOLDFAST_STAYED);
  CHECK(outcomes[1].verdict == HOLDFAST_MOVED);
  CHECK(outcomes[1].stop_reason == HOLDFAST_DECIDED);
  CHECK(outcomes[1].end_time < outcomes[0].end_time);
  holdfast_screen_free(screen);
  holdfast_settings_free(settings);
}

/* The same answer as of the verdicts. */
static void tells_what_holds(void) {
  holdfast_screen* screen = screen_with(NULL);
  const holdfast_layouts all = layouts();
  holdfast_outcome outcomes[world_count] = {{.size = sizeof outcomes[0]}};
  uint8_t holds[layout_count];
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_OK);
  CHECK(holdfast_screen_holds(screen, &all, holds, layout_count) == HOLDFAST_OK);
  for (int i = 0; i < layout_count; ++i)
    CHECK(holds[i] == (outcomes[2 * i].verdict == HOLDFAST_STAYED && outcomes[2 * i + 1].verdict == HOLDFAST_STAYED));
  CHECK(holds[1] == 1 && holds[0] == 0);
  CHECK(holdfast_screen_holds(screen, &all, holds, 1) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_holds(screen, &all, NULL, layout_count) == HOLDFAST_BAD_ARGUMENT);
  holdfast_screen_free(screen);
}

/* A program may know an earlier or a later version of a structure than the library. */
static void fills_other_versions(void) {
  typedef struct {
    size_t size;
    uint64_t layout, acceleration;
  } earlier;
  typedef struct {
    holdfast_outcome known;
    double unknown;
  } later;
  holdfast_screen* screen = screen_with(NULL);
  const holdfast_layouts all = layouts();
  earlier short_ones[world_count + 1] = {{.size = sizeof(earlier)}};
  later long_ones[world_count] = {{.known = {.size = sizeof(later)}}};
  holdfast_outcome unset[world_count] = {{.size = 0}};
  short_ones[world_count].layout = 99;
  long_ones[1].unknown = 5.0;
  CHECK(holdfast_screen_evaluate(screen, &all, (holdfast_outcome*)(void*)short_ones, world_count) == HOLDFAST_OK);
  CHECK(short_ones[3].layout == 1 && short_ones[3].acceleration == 1 && short_ones[world_count].layout == 99);
  CHECK(holdfast_screen_evaluate(screen, &all, &long_ones[0].known, world_count) == HOLDFAST_OK);
  CHECK(long_ones[1].known.verdict == HOLDFAST_MOVED && long_ones[1].unknown == 0.0);
  CHECK(holdfast_screen_evaluate(screen, &all, unset, world_count) == HOLDFAST_BAD_ARGUMENT);
  CHECK(strstr(holdfast_screen_message(screen), "outcomes.size is 0") != NULL);
  holdfast_screen_free(screen);
}

static void takes_a_norm(void) {
  const holdfast_screen_options options = {.size = sizeof options, .norm = "road"};
  const holdfast_screen_options wrong = {.size = sizeof wrong, .norm = "raod"};
  const holdfast_layouts all = layouts();
  holdfast_outcome outcomes[layout_count * 5] = {{.size = sizeof outcomes[0]}};
  holdfast_screen* screen = NULL;
  CHECK(holdfast_screen_new(NULL, &options, &screen) == HOLDFAST_OK);
  CHECK(holdfast_screen_acceleration_count(screen) == 4);
  CHECK(holdfast_screen_add_acceleration(screen, "weak", kWeak, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_acceleration_count(screen) == 5);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, layout_count * 5) == HOLDFAST_OK);
  CHECK(outcomes[0].verdict == HOLDFAST_MOVED);
  CHECK(outcomes[4].verdict == HOLDFAST_STAYED);
  holdfast_screen_free(screen);
  CHECK(holdfast_screen_acceleration_count(screen) == 0);
  CHECK(holdfast_screen_new(NULL, &wrong, &screen) == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_screen_message(screen), "did you mean road?") != NULL);
  holdfast_screen_free(screen);
}

static void tells_what_replicas_say(void) {
  const holdfast_layouts all = layouts();
  holdfast_outcome outcomes[world_count] = {{.size = sizeof outcomes[0]}};
  holdfast_replicas replicas = {.size = sizeof replicas};
  holdfast_settings* settings = holdfast_settings_new();
  holdfast_screen* screen = NULL;
  CHECK(holdfast_settings_set(settings, "Screening", "Replicas", "32") == HOLDFAST_OK);
  CHECK(holdfast_screen_new(settings, NULL, &screen) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, "gentle", kGentle, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, kStrong, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_OK);
  CHECK(holdfast_screen_replicas(screen, 0, &replicas) == HOLDFAST_OK);
  CHECK(replicas.verdict == HOLDFAST_REPLICAS_HOLD && replicas.count == 32 && replicas.failed == 0);
  CHECK(replicas.share == 0.0 && replicas.wilson_low == 0.0 && replicas.wilson_high < 0.11);
  CHECK(holdfast_screen_replicas(screen, 1, &replicas) == HOLDFAST_OK);
  CHECK(replicas.verdict == HOLDFAST_REPLICAS_FAIL && replicas.count == 7 && replicas.failed == 7);
  CHECK(replicas.cpu_seconds > 0.0);
  CHECK(holdfast_screen_replicas(screen, world_count, &replicas) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_replicas(screen, 0, NULL) == HOLDFAST_BAD_ARGUMENT);
  holdfast_screen_free(screen);
  holdfast_settings_free(settings);
}

static void tells_what_impacts_did(void) {
  const holdfast_layouts all = layouts();
  holdfast_outcome outcomes[world_count] = {{.size = sizeof outcomes[0]}};
  holdfast_damage damage = {.size = sizeof damage};
  double number;
  holdfast_settings* settings = holdfast_settings_new();
  holdfast_screen* screen = screen_with(NULL);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_OK);
  CHECK(holdfast_screen_damage(screen, 0, &damage) == HOLDFAST_BAD_ARGUMENT); /* it was not asked for */
  holdfast_screen_free(screen);
  CHECK(holdfast_settings_set(settings, "Screening", "Damage", "true") == HOLDFAST_OK);
  CHECK(holdfast_screen_new(settings, NULL, &screen) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, "gentle", kGentle, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, kStrong, 1) == HOLDFAST_OK);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_OK);
  CHECK(holdfast_screen_damage(screen, 0, &damage) == HOLDFAST_OK);
  CHECK(damage.boxes_beyond == 0 && damage.velocity_change == 0.0F); /* the floor carries it */
  CHECK(damage.peak_acceleration > 1.999F && damage.peak_acceleration < 2.001F);
  CHECK(holdfast_screen_damage(screen, 1, &damage) == HOLDFAST_OK);
  CHECK(damage.peak_acceleration > 2.001F);
  CHECK(holdfast_screen_damage(screen, world_count, &damage) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_damage(screen, 0, NULL) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_number(screen, 1, "peak_acceleration", &number) == HOLDFAST_OK);
  CHECK((float)number == damage.peak_acceleration);
  CHECK(holdfast_screen_number(screen, 1, "load_shift", &number) == HOLDFAST_OK && isnan(number)); /* not asked for */
  CHECK(holdfast_screen_number(screen, 1, "peak", &number) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_number(screen, world_count, "load_shift", &number) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_number(screen, 1, NULL, &number) == HOLDFAST_BAD_ARGUMENT);
  holdfast_screen_free(screen);
  holdfast_settings_free(settings);
}

static void submits_and_polls(void) {
  const holdfast_screen_options options = {.size = sizeof options, .threads = 2, .most_in_flight = 2};
  holdfast_screen* screen = screen_with(&options);
  const holdfast_layouts all = layouts();
  holdfast_outcome expected[world_count] = {{.size = sizeof expected[0]}};
  holdfast_outcome outcomes[acceleration_count] = {{.size = sizeof outcomes[0]}};
  uint64_t ticket = 99;
  CHECK(holdfast_screen_evaluate(screen, &all, expected, world_count) == HOLDFAST_OK);
  CHECK(holdfast_screen_poll(screen, 0.0, 0, &ticket, outcomes, acceleration_count) == HOLDFAST_NONE);
  CHECK(holdfast_screen_submit(screen, kBoxes, 1, NULL) == HOLDFAST_OK);
  CHECK(holdfast_screen_submit(screen, kBoxes + 14, 2, &ticket) == HOLDFAST_OK);
  CHECK(ticket == 1);
  CHECK(holdfast_screen_submit(screen, kBoxes, 1, &ticket) == HOLDFAST_FULL);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, kWeak, 1) == HOLDFAST_ERROR);
  CHECK(holdfast_screen_poll(screen, 100.0, 1, &ticket, outcomes, 1) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_poll(screen, 100.0, 7, &ticket, outcomes, acceleration_count) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_poll(screen, 100.0, 1, &ticket, outcomes, acceleration_count) == HOLDFAST_OK);
  CHECK(ticket == 0);
  CHECK(outcomes[1].state_hash == expected[1].state_hash);
  CHECK(holdfast_screen_poll(screen, 100.0, 0, &ticket, outcomes, acceleration_count) == HOLDFAST_OK);
  CHECK(ticket == 1);
  CHECK(outcomes[1].state_hash == expected[5].state_hash);
  CHECK(holdfast_screen_submit(screen, kBoxes, 1, NULL) == HOLDFAST_OK);
  CHECK(holdfast_screen_cancel(screen) == HOLDFAST_OK);
  CHECK(holdfast_screen_poll(screen, HUGE_VAL, 0, NULL, outcomes, acceleration_count) == HOLDFAST_OK);
  CHECK(holdfast_screen_submit(screen, kBoxes, 1, NULL) == HOLDFAST_OK);
  holdfast_screen_free(screen); /* with a layout in flight */
}

static void settles_settings(void) {
  holdfast_settings* settings = holdfast_settings_new();
  holdfast_screen* screen = NULL;
  holdfast_world* world = NULL;
  CHECK(settings != NULL);
  CHECK(holdfast_settings_read(settings, "[Container]\nLength = 600\n[Material 1]\nDensity = 300\n") == HOLDFAST_OK);
  CHECK(holdfast_settings_read(settings, "[Container]\nLenght = 600\n") == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_settings_message(settings), "config:2") != NULL);
  CHECK(holdfast_settings_set(settings, "Native", "Accuracy", "screening") == HOLDFAST_OK);
  CHECK(strcmp(holdfast_settings_message(settings), "") == 0);
  CHECK(holdfast_settings_set(settings, "Native", "Accuracy", "perfect") == HOLDFAST_ERROR);
  CHECK(holdfast_settings_set(settings, "Native", NULL, "1") == HOLDFAST_BAD_ARGUMENT);
  CHECK(strstr(holdfast_settings_message(settings), "key is NULL") != NULL);
  CHECK(holdfast_screen_new(settings, NULL, &screen) == HOLDFAST_OK);
  holdfast_screen_free(screen);
  CHECK(holdfast_settings_set(settings, "Material 1", "Mass", "30") == HOLDFAST_OK);
  CHECK(holdfast_screen_new(settings, NULL, &screen) == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_screen_message(screen), "both a mass and a density") != NULL);
  CHECK(holdfast_screen_error_count(screen) == 1);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, kWeak, 1) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_cancel(screen) == HOLDFAST_OK);
  holdfast_screen_free(screen);
  CHECK(holdfast_world_new(settings, kBoxes, 1, HOLDFAST_METRE, kWeak, 1, &world) == HOLDFAST_ERROR);
  CHECK(holdfast_world_advance(world, 1.0) == HOLDFAST_BAD_ARGUMENT);
  holdfast_world_free(world);
  holdfast_settings_free(settings);
}

static void takes_a_world_forward(void) {
  holdfast_settings* settings = holdfast_settings_new();
  double forces[24];
  holdfast_world* world = NULL;
  holdfast_screen* screen = screen_with(NULL);
  const holdfast_layouts all = layouts();
  holdfast_outcome outcomes[world_count] = {{.size = sizeof outcomes[0]}};
  double time = -1.0;
  double end = -1.0;
  double poses[14];
  uint64_t hash = 0;
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_OK);
  holdfast_screen_free(screen);
  CHECK(holdfast_world_new(NULL, kBoxes + 14, 2, HOLDFAST_METRE, kStrong, 1, &world) == HOLDFAST_OK);
  CHECK(holdfast_world_poses(world, poses, 2) == HOLDFAST_OK);
  CHECK(poses[0] == 1.25 && poses[3] == 1.0 && poses[9] == 0.75);
  CHECK(holdfast_world_poses(world, poses, 1) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_poses(world, NULL, 2) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_advance(world, nan("")) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, -1.0) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, 0.5) == HOLDFAST_OK);
  CHECK(holdfast_world_times(world, &time, &end) == HOLDFAST_OK);
  CHECK(time == 0.5 && end == 6.0); /* it may run out for 5 s */
  CHECK(holdfast_world_advance(world, HUGE_VAL) == HOLDFAST_OK);
  CHECK(holdfast_world_hash(world, NULL) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_hash(world, &hash) == HOLDFAST_OK);
  CHECK(hash == outcomes[5].state_hash);
  CHECK(holdfast_world_side_forces(world, forces, 8) == HOLDFAST_BAD_ARGUMENT); /* not asked for */
  CHECK(strstr(holdfast_world_message(world), "WallForces") != NULL);
  holdfast_world_free(world);
  CHECK(holdfast_settings_set(settings, "Screening", "WallForces", "true") == HOLDFAST_OK);
  CHECK(holdfast_world_new(settings, kBoxes + 14, 2, HOLDFAST_METRE, kWeak, 1, &world) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, 0.5) == HOLDFAST_OK);
  CHECK(holdfast_world_side_forces(world, forces, 7) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_side_forces(world, NULL, 8) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_side_forces(world, forces, 8) == HOLDFAST_OK);
  CHECK(fabs(forces[2] + 62.5 * 9.81) < 1e-3 &&
        fabs(forces[0] + 62.5 * 4.8) < 1e-3); /* the weight and m a of 62.5 kg */
  holdfast_settings_free(settings);
  CHECK(holdfast_world_times(world, NULL, NULL) == HOLDFAST_OK);
  CHECK(holdfast_world_new(NULL, kBoxes, 1, 2, kStrong, 1, NULL) == HOLDFAST_BAD_ARGUMENT);
  holdfast_world_free(world);
  CHECK(holdfast_world_new(NULL, kBoxes, 1, 2, kStrong, 1, &world) == HOLDFAST_BAD_ARGUMENT);
  CHECK(strstr(holdfast_world_message(world), "unit is 2") != NULL);
  holdfast_world_free(world);
}

/* Acceleration, friction and forces change while a world goes. */
static void changes_a_world(void) {
  const double still[] = {0.0, 4.0, 0.0, 0.0, 0.0};
  const double none[3] = {0.0, 0.0, 0.0};
  const double brake[3] = {7.0, 0.0, 0.0};
  const double push[3] = {0.0, 1.5 * 0.5 * 31.25 * 9.81, 0.0};
  const double floor_point[3] = {2.25, 1.25, 0.0};
  const double wrong[3] = {0.0, HUGE_VAL, 0.0};
  double poses[7];
  double velocities[6];
  holdfast_world* world = NULL;
  CHECK(holdfast_world_new(NULL, kBoxes, 1, HOLDFAST_METRE, still, 1, &world) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, 0.5) == HOLDFAST_OK);
  CHECK(holdfast_world_set_force(world, 0, push, floor_point) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, 0.75) == HOLDFAST_OK);
  CHECK(holdfast_world_velocities(world, velocities, 1) == HOLDFAST_OK);
  CHECK(fabs(velocities[1] - 0.25 * 0.5 * 0.5 * 9.81) < 1e-4 && velocities[0] == 0.0 && velocities[5] == 0.0);
  CHECK(holdfast_world_set_force(world, 0, none, NULL) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, 2.0) == HOLDFAST_OK);
  CHECK(holdfast_world_set_friction(world, 0.5, 0.2, 0.5) == HOLDFAST_OK);
  CHECK(holdfast_world_set_acceleration(world, brake) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, 2.5) == HOLDFAST_OK);
  CHECK(holdfast_world_poses(world, poses, 1) == HOLDFAST_OK);
  CHECK(fabs(poses[0] - 2.25 + 0.125 * (7.0 - 0.2 * 9.81)) < 1e-4);
  CHECK(holdfast_world_velocities(world, velocities, 0) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_velocities(world, NULL, 1) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_set_acceleration(world, NULL) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_set_acceleration(world, wrong) == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_world_message(world), "the acceleration cannot be used") != NULL);
  CHECK(holdfast_world_set_friction(world, -1.0, 0.2, 0.5) == HOLDFAST_ERROR);
  CHECK(holdfast_world_set_force(world, 0, NULL, NULL) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_world_set_force(world, 1, none, NULL) == HOLDFAST_ERROR);
  CHECK(holdfast_world_set_force(world, 0, wrong, NULL) == HOLDFAST_ERROR);
  holdfast_world_free(world);
  CHECK(holdfast_world_velocities(world, velocities, 1) == HOLDFAST_BAD_HANDLE);
  CHECK(holdfast_world_set_acceleration(world, none) == HOLDFAST_BAD_HANDLE);
  CHECK(holdfast_world_set_friction(world, 0.5, 0.5, 0.5) == HOLDFAST_BAD_HANDLE);
  CHECK(holdfast_world_set_force(world, 0, none, NULL) == HOLDFAST_BAD_HANDLE);
}

/* Masses, mats, names and containers are arrays beside the rows of numbers; what is wrong with them has its box. */
static void takes_loads(void) {
  const double masses[] = {NAN, NAN, 60.0, 5.0};
  const double wrong_masses[] = {NAN, -1.0, NAN, NAN};
  const double mats[] = {0.9, NAN, NAN, NAN};
  const char* const box_names[] = {NULL, "Pump", NULL, NULL};
  const char* const containers[] = {NULL, "20", NULL};
  const char* const barns[] = {NULL, "barn", NULL};
  holdfast_layouts all = layouts();
  holdfast_outcome before[world_count] = {{.size = sizeof before[0]}};
  holdfast_outcome after[world_count] = {{.size = sizeof after[0]}};
  holdfast_problem problem = {.size = sizeof problem};
  holdfast_world* world = NULL;
  uint64_t ticket = 0;
  uint64_t hash = 0;
  holdfast_screen* screen = screen_with(NULL);
  CHECK(holdfast_screen_evaluate(screen, &all, before, world_count) == HOLDFAST_OK);
  all.masses = masses;
  all.mats = mats;
  all.box_names = box_names;
  all.containers = containers;
  CHECK(holdfast_screen_evaluate(screen, &all, after, world_count) == HOLDFAST_OK);
  CHECK(before[1].verdict == HOLDFAST_MOVED && after[1].verdict == HOLDFAST_STAYED); /* the mat holds it */
  CHECK(before[5].state_hash != after[5].state_hash);
  all.masses = wrong_masses;
  CHECK(holdfast_screen_evaluate(screen, &all, after, world_count) == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_screen_message(screen), "the mass of box 1 (Pump) is not possible: -1") != NULL);
  CHECK(holdfast_screen_error(screen, 0, &problem) == HOLDFAST_OK);
  CHECK(problem.layout == 1 && problem.box == 0 && problem.box_column == -1);
  all.masses = masses;
  all.containers = barns;
  CHECK(holdfast_screen_evaluate(screen, &all, after, world_count) == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_screen_message(screen), "no type of container: barn") != NULL);
  all.size = offsetof(holdfast_layouts, masses); /* an earlier version */
  CHECK(holdfast_screen_evaluate(screen, &all, after, world_count) == HOLDFAST_OK);
  CHECK(before[5].state_hash == after[5].state_hash);

  all.size = sizeof all;
  all.containers = NULL;
  CHECK(holdfast_screen_submit_layout(screen, &all, &ticket) == HOLDFAST_BAD_ARGUMENT);
  all.offsets = kOffsets + 2; /* the stack alone */
  all.layout_count = 1;
  CHECK(holdfast_screen_submit_layout(screen, &all, &ticket) == HOLDFAST_OK);
  CHECK(holdfast_screen_poll(screen, 60.0, 0, NULL, after, acceleration_count) == HOLDFAST_OK);
  CHECK(holdfast_world_new_of_layout(NULL, &all, HOLDFAST_METRE, kStrong, 1, &world) == HOLDFAST_OK);
  CHECK(holdfast_world_advance(world, 100.0) == HOLDFAST_OK);
  CHECK(holdfast_world_hash(world, &hash) == HOLDFAST_OK && hash == after[1].state_hash);
  holdfast_world_free(world);
  holdfast_screen_free(screen);
}

/* What is wrong with a box is told by layout, box and number, or marked. */
static void names_what_is_wrong(void) {
  const double bad[] = {2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1.0, /**/
                        2.0, 1.0, 0.5, 2.5, 1.5, 0.1, 1.0};
  const size_t offsets[] = {0, 1, 2};
  const char* const names[] = {NULL, "second"};
  const holdfast_layouts all = {
      .size = sizeof all, .boxes = bad, .box_count = 2, .offsets = offsets, .layout_count = 2, .names = names};
  holdfast_screen_options options = {.size = sizeof options};
  holdfast_outcome outcomes[4] = {{.size = sizeof outcomes[0]}};
  holdfast_problem problem = {.size = sizeof problem};
  holdfast_screen* screen = screen_with(&options);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, 4) == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_screen_message(screen), "second: box 1 has a negative height") != NULL);
  CHECK(holdfast_screen_error_count(screen) == 1);
  CHECK(holdfast_screen_error(screen, 0, &problem) == HOLDFAST_OK);
  CHECK(problem.layout == 1 && problem.box == 0 && problem.box_column == 5);
  CHECK(strcmp(problem.file, "second") == 0 && strcmp(problem.value, "-40 cm") == 0);
  CHECK(holdfast_screen_error(screen, 1, &problem) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_error(screen, 0, NULL) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_submit(screen, bad + 7, 1, NULL) == HOLDFAST_ERROR);
  holdfast_screen_free(screen);
  options.mark_bad_layouts = 1;
  screen = screen_with(&options);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, 4) == HOLDFAST_OK);
  CHECK(outcomes[0].status == 0 && outcomes[2].status == HOLDFAST_BAD_LAYOUT);
  CHECK(holdfast_screen_error_count(screen) == 1);
  CHECK(strstr(holdfast_screen_outcome_message(screen, 2), "negative height") != NULL);
  CHECK(strcmp(holdfast_screen_outcome_message(screen, 0), "") == 0);
  CHECK(strcmp(holdfast_screen_outcome_message(screen, 4), "") == 0);
  holdfast_screen_free(screen);
}

/* Mistakes of the calling program have a status and a message. */
static void survives_abuse(void) {
  const size_t falling[] = {1, 0};
  const size_t beyond[] = {0, 5};
  holdfast_screen_options options = {.size = 3};
  holdfast_screen* screen = NULL;
  holdfast_settings* settings = holdfast_settings_new();
  holdfast_layouts all = layouts();
  holdfast_margins margins[layout_count] = {{.size = sizeof margins[0]}};
  holdfast_replicas replicas = {.size = sizeof replicas};
  holdfast_outcome outcomes[world_count] = {{.size = sizeof outcomes[0]}};
  struct {
    holdfast_screen_options known;
    size_t unknown;
  } later = {.known = {.size = sizeof later}, .unknown = 1};
  CHECK(holdfast_screen_new(NULL, NULL, NULL) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_new(NULL, &options, &screen) == HOLDFAST_BAD_ARGUMENT);
  CHECK(strstr(holdfast_screen_message(screen), "options.size is 3") != NULL);
  holdfast_screen_free(screen);
  CHECK(holdfast_screen_new(NULL, &later.known, &screen) == HOLDFAST_BAD_ARGUMENT);
  holdfast_screen_free(screen);
  later.unknown = 0;
  CHECK(holdfast_screen_new(NULL, &later.known, &screen) == HOLDFAST_OK);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  CHECK(strstr(holdfast_screen_message(screen), "has no acceleration") != NULL);
  CHECK(holdfast_screen_margins(screen, &all, margins, all.layout_count) == HOLDFAST_OK);
  CHECK(margins[0].margin[0] > 0.49 && margins[0].margin[0] <= 0.5001 && margins[0].critical_box[0] == 1);
  CHECK(margins[0].margin_within_limits[0] >= margins[0].margin[0] && margins[0].margin_within_limits[0] < 0.51);
  CHECK(margins[0].critical_box_within_limits[0] == 1 && margins[1].size == sizeof margins[0]);
  CHECK(margins[0].trials > 4 && margins[0].cpu_seconds > 0.0);
  CHECK(holdfast_screen_replicas(screen, 0, &replicas) == HOLDFAST_BAD_ARGUMENT); /* nothing is evaluated */
  CHECK(holdfast_screen_margins(screen, &all, margins, all.layout_count - 1) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_margins(screen, &all, NULL, all.layout_count) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_submit(screen, kBoxes, 1, NULL) == HOLDFAST_BAD_ARGUMENT);
  holdfast_screen_free(screen);
  options.size = offsetof(holdfast_screen_options, accuracy); /* an earlier version */
  options.accuracy = "not read";
  options.engine = "warp";
  CHECK(holdfast_screen_new(NULL, &options, &screen) == HOLDFAST_ERROR);
  CHECK(strstr(holdfast_screen_message(screen), "warp") != NULL);
  holdfast_screen_free(screen);

  screen = screen_with(NULL);
  CHECK(holdfast_screen_evaluate(screen, NULL, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_evaluate(screen, &all, NULL, world_count) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count - 1) == HOLDFAST_BAD_ARGUMENT);
  all.boxes = NULL;
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  all = layouts();
  all.box_count = (size_t)-1;
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  all = layouts();
  all.offsets = NULL;
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  all.layout_count = 1;
  all.offsets = falling;
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  all.offsets = beyond;
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  all.size = 0;
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_ARGUMENT);
  all = (holdfast_layouts){.size = sizeof all};
  CHECK(holdfast_screen_evaluate(screen, &all, NULL, 0) == HOLDFAST_OK);
  CHECK(holdfast_screen_record(screen, &all, NULL, NULL) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_record(screen, &all, "nowhere.h5", NULL) == HOLDFAST_ERROR);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, NULL, 1) == HOLDFAST_BAD_ARGUMENT);
  CHECK(holdfast_screen_add_acceleration(screen, NULL, NULL, 0) == HOLDFAST_ERROR);
  CHECK(holdfast_screen_poll(screen, nan(""), 0, NULL, outcomes, acceleration_count) == HOLDFAST_NONE);

  /* Objects that are of another kind, not there, or freed. */
  CHECK(holdfast_screen_cancel((holdfast_screen*)(void*)settings) == HOLDFAST_BAD_HANDLE);
  holdfast_screen_free((holdfast_screen*)(void*)settings);
  CHECK(holdfast_settings_set(settings, "Native", "Jump", "no") == HOLDFAST_OK);
  holdfast_settings_free(settings);
  holdfast_settings_free(settings);
  CHECK(holdfast_settings_read(settings, "") == HOLDFAST_BAD_HANDLE);
  CHECK(holdfast_screen_new(settings, NULL, &screen) == HOLDFAST_BAD_HANDLE);
  CHECK(screen == NULL);
  screen = screen_with(NULL);
  holdfast_screen_free(screen);
  holdfast_screen_free(screen);
  holdfast_screen_free(NULL);
  all = layouts();
  CHECK(holdfast_screen_evaluate(screen, &all, outcomes, world_count) == HOLDFAST_BAD_HANDLE);
  CHECK(holdfast_screen_cancel(screen) == HOLDFAST_BAD_HANDLE);
  CHECK(holdfast_screen_error_count(screen) == 0);
  CHECK(strstr(holdfast_screen_message(screen), "no such object") != NULL);
  CHECK(strstr(holdfast_world_message(NULL), "no such object") != NULL);
  holdfast_world_free(NULL);
}

int main(void) {
  int major = 0;
  int minor = 0;
  int patch = 0;
  CHECK(sscanf(holdfast_version(), "%d.%d.%d", &major, &minor, &patch) == 3);
  CHECK(HOLDFAST_VERSION == 10000 * major + 100 * minor + patch);
  evaluates();
  ends_early();
  tells_what_holds();
  fills_other_versions();
  takes_a_norm();
  tells_what_replicas_say();
  tells_what_impacts_did();
  submits_and_polls();
  settles_settings();
  takes_a_world_forward();
  changes_a_world();
  takes_loads();
  names_what_is_wrong();
  survives_abuse();
  if (failures > 0) fprintf(stderr, "%d checks failed\n", failures);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
