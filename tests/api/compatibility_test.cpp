#include "holdfast/holdfast.hpp"

#include <catch2/catch.hpp>

using namespace holdfast;

// A program passes these types by value and address, so that a member more is another size, and needs another soname.
// The numbers are of one platform: what changes them there changes them elsewhere.
#if defined(__x86_64__) && defined(__GLIBCXX__)
TEST_CASE("compatibility: public types have the sizes of version 2", "[api][compatibility]") {
  CHECK(sizeof(Problem) == 200);
  CHECK(sizeof(Error) == 64);
  CHECK(sizeof(Box) == 224);
  CHECK(sizeof(Layout) == 216);
  CHECK(sizeof(LayoutView) == 120);
  CHECK(sizeof(DropSide) == 40);
  CHECK(sizeof(Container) == 144);
  CHECK(sizeof(ContainerType) == 128);
  CHECK(sizeof(LoadFileOptions) == 232);
  CHECK(sizeof(Segment) == 40);
  CHECK(sizeof(Acceleration) == 88);
  CHECK(sizeof(Setting) == 96);
  CHECK(sizeof(ScreenOptions) == 312);
  CHECK(sizeof(RecordOptions) == 40);
  CHECK(sizeof(FinishedLayout) == 32);
  CHECK(sizeof(Screen) == 8);
  CHECK(sizeof(Pose) == 56);
  CHECK(sizeof(Velocity) == 48);
  CHECK(sizeof(World) == 8);
  CHECK(sizeof(EngineInfo) == 96);
  CHECK(sizeof(BoxOutcome) == 64);
  CHECK(sizeof(Series) == 96);
  CHECK(sizeof(WallForce) == 80);
  CHECK(sizeof(ReplicaOutcome) == 72);
  CHECK(sizeof(DamageOutcome) == 88);
  CHECK(sizeof(WorldOutcome) == 528);
  CHECK(sizeof(MarginSpread) == 96);
  CHECK(sizeof(LayoutMargins) == 208);
  CHECK(sizeof(LayoutIndicators) == 120);
}
#endif
