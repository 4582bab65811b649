// Small scripted scenarios made from a number, for laws that hold for all episodes: things of any size and
// shape on a line, some of them moving, commands that sometimes fail, lessons and drives in any order.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace aerascope {

// The texts of a scenario, as LoadScenarioFromFiles takes them. The same number gives the same texts.
std::map<std::string, std::string> AnyScenario(std::uint64_t seed);

}  // namespace aerascope
