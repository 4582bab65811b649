// What the targets on scenarios share: a text as a scenario file, with all files it may name in memory.
//
// The text may bring its own seed, after a line "=====".
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "engine/episode/scenario.h"

namespace aerascope {

inline constexpr std::string_view kSeed = R"(h:(ent 1)
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

inline constexpr std::string_view kScene = R"(<mujoco><worldbody>
  <body name="c1" pos="0 0 0.1"><freejoint/><geom size="0.02"/></body></worldbody></mujoco>)";

inline constexpr std::string_view kSeparator = "\n=====\n";

inline Result<Scenario> ScenarioFromText(std::string_view text) {
  const std::size_t end = text.find(kSeparator);
  std::map<std::string, std::string> files;
  files["scenario.toml"] = text.substr(0, end);
  files["seed.replicode"] = end == std::string_view::npos ? kSeed : text.substr(end + kSeparator.size());
  files["world/scene.xml"] = kScene;
  return LoadScenarioFromFiles(files);
}

}  // namespace aerascope
