// Prints, over many seeds of pose noise, how often each grab holds each object, whether what was held can be
// carried and set down again, and how the reports of places behaved on the way.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/engine/world/tabletop.h"

namespace aerascope {
namespace {

struct Tally {
  int grabbed = 0, lifted = 0, places_kept = 0, carried = 0, released = 0, back_in_place = 0;
  double worst_drift_m = 0;  // of the object, between before the grab and after the release
  double worst_speed = 0;    // of the object at the end of a frame
};

std::array<double, 3> TruePlace(const World& world, std::size_t object) {
  const WorldState state = world.State();
  const std::size_t at = state.qpos.size() - 7 * 5 + 7 * object;
  return {state.qpos[at], state.qpos[at + 1], state.qpos[at + 2]};
}

double Speed(const World& world, std::size_t object) {
  const WorldState state = world.State();
  const std::size_t at = state.qvel.size() - 6 * 5 + 6 * object;
  return std::hypot(state.qvel[at], state.qvel[at + 1], state.qvel[at + 2]);
}

void Try(const MujocoWorldConfig& config, Duration frame, std::size_t object, const std::string& grab,
         Tally& tally) {
  auto world = MakeMujocoWorld(config);
  if (!world) {
    std::printf("%s\n", world.error().message.c_str());
    std::exit(1);
  }
  Driver driver(**world, frame);
  const std::string name = config.objects[object].entity;
  driver.Do({});
  const auto moved = driver.MoveTo(name);
  if (moved.executed.size() != 1 || driver.Value("h", "position") != driver.Value(name, "position")) {
    std::printf("seed %llu: %s at %s, hand at %s\n", static_cast<unsigned long long>(config.noise.seed),
                name.c_str(), ToText(driver.Value(name, "position")).c_str(),
                ToText(driver.Value("h", "position")).c_str());
    for (const auto& note : moved.notes) std::printf("  %s\n", note.c_str());
  }
  std::vector<Term> places;
  for (const auto& other : config.objects) places.push_back(driver.Value(other.entity, "position"));
  const auto before = TruePlace(**world, object);
  driver.Command(grab);
  const bool held = driver.Holding() == "[" + name + "]";
  const bool kept_1 =
      driver.Value("h", "position") == places[object] && driver.Value(name, "position") == places[object];
  tally.grabbed += driver.Holding() != "[]";
  tally.lifted += TruePlace(**world, object)[2] > before[2] + 0.1;
  tally.worst_speed = std::max(tally.worst_speed, Speed(**world, object));
  if (held) {
    driver.Command("release");
    tally.released += driver.Holding() == "[]";
    const auto after = TruePlace(**world, object);
    tally.back_in_place += std::abs(after[2] - before[2]) < 0.003;
    tally.worst_drift_m =
        std::max(tally.worst_drift_m, std::hypot(after[0] - before[0], after[1] - before[1]));
    tally.worst_speed = std::max(tally.worst_speed, Speed(**world, object));
  }
  bool kept_2 = kept_1;
  for (std::size_t i = 0; i < places.size(); ++i)
    kept_2 = kept_2 && driver.Value(config.objects[i].entity, "position") == places[i];
  tally.places_kept += kept_2;
  if (!held) return;
  // Grab again, carry towards the middle, look.
  driver.Command(grab);
  const Term at = driver.Value(name, "position");
  const double dx = at[0].number() > 0 ? -0.05 : 0.05;
  driver.Move(dx, -0.025);
  const Term now = driver.Value(name, "position");
  if (std::getenv("SURVEY_DETAILS")) {
    const auto place = TruePlace(**world, object);
    std::printf(
        "  %s from %s true (%.4f %.4f) by (%g, -0.025) to %s, hand %s, true (%.4f %.4f %.4f), holding %s\n",
        name.c_str(), ToText(at).c_str(), before[0], before[1], dx, ToText(now).c_str(),
        ToText(driver.Value("h", "position")).c_str(), place[0], place[1], place[2],
        driver.Holding().c_str());
  }
  tally.carried += driver.Holding() == "[" + name + "]" && now == driver.Value("h", "position") &&
                   std::abs(now[0].number() - at[0].number() - dx) < 1e-6;
}

int Main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 50;
  const double frame_s = argc > 2 ? std::atof(argv[2]) : 1;
  const Duration frame{std::llround(frame_s * 1e6)};
  std::printf("%-5s %-12s %9s %7s %9s %9s %7s %12s %11s %11s\n", "", "", "grabbed", "lifted", "released",
              "in place", "carried", "places kept", "worst drift", "worst speed");
  for (const char* grab : {"grab_type_1", "grab_type_2"}) {
    for (std::size_t object = 0; object < 5; ++object) {
      Tally tally;
      MujocoWorldConfig config;
      for (int seed = 1; seed <= seeds; ++seed) {
        config = TabletopConfig(seed);
        if (argc > 3) config.noise.yaw_rad = std::atof(argv[3]);
        Try(config, frame, object, grab, tally);
      }
      std::printf("%-5s %-12s %6d/%-2d %7d %9d %9d %7d %12d %8.1f mm %6.1f mm/s\n",
                  config.objects[object].entity.c_str(), grab, tally.grabbed, seeds, tally.lifted,
                  tally.released, tally.back_in_place, tally.carried, tally.places_kept,
                  1e3 * tally.worst_drift_m, 1e3 * tally.worst_speed);
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace
}  // namespace aerascope

int main(int argc, char** argv) {
  return aerascope::Main(argc, argv);
}
