// What a position sensor reports while things stand, slip and are carried.
#include "engine/world/position_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace aerascope {
namespace {

using Place = std::array<double, 2>;

TEST(PositionSensor, TheFirstReportIsTheNearestMultiple) {
  PositionSensor sensor(0.005, 0.004);
  EXPECT_EQ(sensor.Report({0.0624, -0.0476}), (Place{0.06, -0.05}));
}

TEST(PositionSensor, ReportsAreTheDoublesNearestToTheirDecimalValues) {
  EXPECT_EQ(GridValue(3, 0.1), 0.3);
  EXPECT_EQ(GridValue(-7, 0.005), -0.035);
  EXPECT_FALSE(std::signbit(GridValue(0, 0.005)));
  EXPECT_FALSE(std::signbit(PositionSensor(0.005, 0).Report({-0.0001, 0})[0]));
}

TEST(PositionSensor, TheReportStaysWhileTheThingIsWithinTheDeadband) {
  PositionSensor sensor(0.005, 0.004);
  sensor.Report({0.1, 0});
  EXPECT_EQ(sensor.Report({0.1039, 0.0039}), (Place{0.1, 0}));
  EXPECT_EQ(sensor.Report({0.0961, -0.0039}), (Place{0.1, 0}));
}

TEST(PositionSensor, TheReportChangesWhenTheThingLeftTheDeadband) {
  PositionSensor sensor(0.005, 0.004);
  sensor.Report({0.1, 0});
  EXPECT_EQ(sensor.Report({0.1041, 0}), (Place{0.105, 0}));
}

TEST(PositionSensor, WithoutADeadbandItIsAlwaysTheNearestMultiple) {
  PositionSensor sensor(0.005, 0);
  sensor.Report({0.1, 0});
  EXPECT_EQ(sensor.Report({0.1026, 0}), (Place{0.105, 0}));
  EXPECT_EQ(sensor.Report({0.1024, 0}), (Place{0.1, 0}));
}

TEST(PositionSensor, AThingThatIsCarriedIsReportedToMoveByExactlyThat) {
  PositionSensor sensor(0.005, 0.004);
  sensor.Report({0.1, 0});
  sensor.Report({0.1038, 0});  // slipped, not reported

  // Nearest would be 0.205; but it was carried by 0.1.
  EXPECT_EQ(sensor.Report({0.2038, 0}), (Place{0.2, 0}));
}

TEST(PositionSensor, TheReportIsNeverFurtherFromTheTruthThanTheDeadband) {
  std::mt19937_64 generator(1);
  const auto centred = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1; };
  PositionSensor sensor(0.005, 0.004);
  Place place{0, 0};
  for (int i = 0; i < 10'000; ++i) {
    const double reach = i % 3 == 0 ? 0.1 : 0.003;
    place = {place[0] + reach * centred(), place[1] + reach * centred()};
    const Place report = sensor.Report(place);
    for (int k = 0; k < 2; ++k) {
      ASSERT_LE(std::abs(report[k] - place[k]), 0.004 + 1e-9);
      ASSERT_NEAR(report[k] / 0.005, std::round(report[k] / 0.005), 1e-6);
    }
  }
}

}  // namespace
}  // namespace aerascope
