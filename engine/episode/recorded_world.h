// A RecordedWorld says again what a world said in a recorded episode: the same observations, the same
// executed commands, the same states. With it the reasoner can be run again on exactly what it met.
#pragma once

#include <map>
#include <vector>

#include "engine/store/episode_reader.h"
#include "engine/world/world.h"

namespace aerascope {

class RecordedWorld : public World {
 public:
  // The last `seed_facts` of the episode's properties came from the seed, not from the world. The episode
  // outlives this.
  RecordedWorld(const EpisodeFile& episode, std::size_t seed_facts);

  Result<std::vector<Fact>> Observe(TimeInterval frame) override;
  std::vector<Fact> Properties() const override { return properties_; }
  Result<ActOutcome> Act(std::span<const Term> commands, TimeInterval during) override;
  WorldState State() const override { return state_; }
  WorldDescription Description() const override { return {}; }

 private:
  struct Recorded {
    std::vector<Fact> observed;
    ActOutcome acted;
    WorldState at_start;
  };
  std::vector<Fact> properties_;
  std::map<Time, Recorded> frames_;  // by the frame's start
  std::map<Time, Recorded>::const_iterator current_;
  WorldState state_;
};

}  // namespace aerascope
