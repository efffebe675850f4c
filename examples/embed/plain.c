/* The C interface: one box under two accelerations, and then the same world taken forward in pieces. Prints verdicts,
 * and one state hash per way, which are the same. */
#include <holdfast/holdfast.h>
#include <inttypes.h>
#include <stdio.h>

/* Rows of start, duration and acceleration, and of two corners and a material. */
static const double kWeak[] = {0.0, 1.0, 4.0, 0.0, 0.0};
static const double kBrake[] = {0.0, 1.0, 7.0, 0.0, 0.0};
static const double kBox[] = {2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1.0};

static int evaluate(void) {
  const char* const verdicts[] = {
      [HOLDFAST_STAYED] = "stayed",     [HOLDFAST_MOVED] = "moved",   [HOLDFAST_FELL] = "fell",
      [HOLDFAST_UNSTABLE] = "unstable", [HOLDFAST_FAILED] = "failed", [HOLDFAST_NOT_ASKED] = "not_needed"};
  const size_t offsets[] = {0, 1};
  const holdfast_layouts layouts = {
      .size = sizeof layouts, .boxes = kBox, .box_count = 1, .offsets = offsets, .layout_count = 1};
  holdfast_outcome outcomes[2] = {{.size = sizeof outcomes[0]}};
  holdfast_screen* screen;
  const int failed = holdfast_screen_new(NULL, NULL, &screen) ||
                     holdfast_screen_add_acceleration(screen, "weak", kWeak, 1) ||
                     holdfast_screen_add_acceleration(screen, "brake", kBrake, 1) ||
                     holdfast_screen_evaluate(screen, &layouts, outcomes, 2);
  if (failed)
    fprintf(stderr, "%s\n", holdfast_screen_message(screen));
  else
    printf("%s %s %016" PRIx64 "\n", verdicts[outcomes[0].verdict], verdicts[outcomes[1].verdict],
           outcomes[1].state_hash);
  holdfast_screen_free(screen);
  return failed;
}

/* Until the box has braked with the container, and slid on until it rests. */
static int take_forward(void) {
  uint64_t hash = 0;
  holdfast_world* world;
  int failed = holdfast_world_new(NULL, kBox, 1, HOLDFAST_METRE, kBrake, 1, &world);
  for (int i = 1; i <= 6 && !failed; ++i) {
    double pose[7];
    failed = holdfast_world_advance(world, 0.25 * i) || holdfast_world_poses(world, pose, 1) ||
             holdfast_world_hash(world, &hash);
    if (!failed) printf("%.2f s: x = %.4f m\n", 0.25 * i, pose[0]);
  }
  if (failed)
    fprintf(stderr, "%s\n", holdfast_world_message(world));
  else
    printf("%016" PRIx64 "\n", hash);
  holdfast_world_free(world);
  return failed;
}

int main(void) { return evaluate() || take_forward(); }
