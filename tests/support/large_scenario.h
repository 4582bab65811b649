// Scripted scenarios of any length, for measuring what reads an episode: a hand among many things that is
// taught grasps and switches, carries them over to other things by analogy, watches a ball that is hit now
// and then, wants one thing after another, and brings a lot of knowledge along from elsewhere.
//
// The episode is a real one: the reasoner lives through it, so it passes `aerascope verify`.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace aerascope {

struct LargeScenarioOptions {
  std::uint64_t seed = 1;         // which things are wanted, and how the ball is hit
  std::int64_t frames = 3000;     // of 0.1 s each
  std::int64_t events = 1000000;  // about; not fewer than some hundred a frame can be had
  std::int64_t models = 2000;     // about; a third is learned in the episode, the rest is given
};

// The texts of the scenario, as LoadScenarioFromFiles takes them. The same options give the same texts.
std::map<std::string, std::string> LargeScenario(const LargeScenarioOptions& options);

}  // namespace aerascope
