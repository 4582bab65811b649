// Any bytes as a scenario: the reader answers with a scenario or an error. The text may bring its own seed,
// after a line
// "====="; the files it names are in memory. A small scripted scenario that is accepted is also lived
// through.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "engine/episode/run_episode.h"
#include "engine/episode/scenario.h"

namespace aerascope {
namespace {

constexpr std::string_view kSeed = R"(h:(ent 1)
c1:(ent 1)
s1:(ent 1)
run:(ent 1)
position:(ont 1)
holding:(ont 1)
size:(ont 1)
small:(ont 1)
large:(ont 1)
move:(ont 1)
grab:(ont 1)
release:(ont 1)
(fact (mk.val c1 size small 1) 0s:0ms:0us GIGASEC 1 1)
hold_c1:(mdl [] []
   (fact (mk.val h holding [c1] :) T0: T1: : :)
   (fact run T0: T1: : :)
|[] |[] [stdin] 1 1 1 1 1)
S4:(cst [] []
   (fact (mk.val C: size X: :) T0: T1: : :)
   (fact (mk.val C: position P: :) T0: T1: : :)
|[] |[] [stdin] 1)
)";

constexpr std::string_view kScene = R"(<mujoco><worldbody>
  <body name="c1" pos="0 0 0.1"><freejoint/><geom size="0.02"/></body></worldbody></mujoco>)";

constexpr std::string_view kSeparator = "\n=====\n";

class Nowhere : public EventSink {
 public:
  void Append(Event) override {}
};

// A few frames, and little planning.
void LiveThrough(Scenario scenario) {
  if (WorldKind(scenario) != "scripted" || scenario.max_frames > 60) return;
  scenario.reasoner.max_simulation_nodes = std::min(scenario.reasoner.max_simulation_nodes, 100);
  scenario.reasoner.max_plan_depth = std::min(scenario.reasoner.max_plan_depth, 4);
  auto world = MakeWorld(scenario);
  if (!world) return;
  Nowhere nowhere;
  (void)RunEpisode(scenario, world->get(), &nowhere);
}

void Try(std::string_view text) {
  const std::size_t end = text.find(kSeparator);
  std::map<std::string, std::string> files;
  files["scenario.toml"] = text.substr(0, end);
  files["seed.replicode"] = end == std::string_view::npos ? kSeed : text.substr(end + kSeparator.size());
  files["world/scene.xml"] = kScene;
  Result<Scenario> scenario = LoadScenarioFromFiles(files);
  if (scenario) LiveThrough(std::move(*scenario));
}

}  // namespace
}  // namespace aerascope

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  aerascope::Try({reinterpret_cast<const char*>(data), size});
  return 0;
}
