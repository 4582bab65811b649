// Any scripted scenario that the reader accepts can be lived through, however odd its seed.
#include <algorithm>
#include <cstdint>

#include "engine/episode/run_episode.h"
#include "tests/fuzz/scenario_text.h"

namespace aerascope {
namespace {

class Nowhere : public EventSink {
 public:
  void Append(Event) override {}
};

// A few frames, and little planning: many short lives show more than few long ones.
void LiveThrough(Scenario scenario) {
  if (WorldKind(scenario) != "scripted") return;
  scenario.max_frames = std::min<std::int64_t>(scenario.max_frames, 12);
  scenario.reasoner.max_simulation_nodes = std::min(scenario.reasoner.max_simulation_nodes, 30);
  scenario.reasoner.max_plan_depth = std::min(scenario.reasoner.max_plan_depth, 4);
  auto world = MakeWorld(scenario);
  if (!world) return;
  Nowhere nowhere;
  (void)RunEpisode(scenario, world->get(), &nowhere);
}

}  // namespace
}  // namespace aerascope

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto scenario = aerascope::ScenarioFromText({reinterpret_cast<const char*>(data), size});
  if (scenario) aerascope::LiveThrough(std::move(*scenario));
  return 0;
}
