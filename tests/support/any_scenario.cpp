#include "tests/support/any_scenario.h"

#include <random>
#include <vector>

namespace aerascope {
namespace {

constexpr const char* kSeed = R"(h:(ent 1)
a:(ent 1)
b:(ent 1)
c:(ent 1)
position:(ont 1)
holding:(ont 1)
speed:(ont 1)
size:(ont 1)
shape:(ont 1)
essence:(ont 1)
hand:(ont 1)
small:(ont 1)
large:(ont 1)
cube:(ont 1)
sphere:(ont 1)
move:(ont 1)
grab:(ont 1)
clutch:(ont 1)
release:(ont 1)
(fact (mk.val h essence hand 1) 0s:0ms:0us GIGASEC 1 1)
S0:(cst [] []
   (fact (mk.val H: essence hand :) T0: T1: : :)
   (fact (mk.val H: position P: :) T0: T1: : :)
|[] |[] [stdin] 1)
S3:(cst [] []
   (fact (mk.val C: shape X: :) T0: T1: : :)
   (fact (mk.val C: position P: :) T0: T1: : :)
|[] |[] [stdin] 1)
S4:(cst [] []
   (fact (mk.val C: size X: :) T0: T1: : :)
   (fact (mk.val C: position P: :) T0: T1: : :)
|[] |[] [stdin] 1)
)";

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) {}

  std::string Make() {
    std::string text = "title = \"Any\"\nrandom_seed = " + std::to_string(Below(1000)) +
                       "\nmax_frames = " + std::to_string(6 + Below(10)) +
                       "\n[seed]\nreplicode = \"seed.replicode\"\n";
    text += World() + Reasoner();
    if (Chance())
      text +=
          "[events]\noff = [" + std::string(Chance() ? "\"GoalSkipped\", \"CauseConsidered\"" : "") + "]\n";
    for (int frame = 1 + Below(2), left = 2 + Below(5); left > 0; --left, frame += Below(3) > 0 ? 1 : 2)
      text += Lesson(frame);
    for (int left = Below(4); left > 0; --left) text += Drive();
    return text;
  }

 private:
  int Below(int limit) { return static_cast<int>(random_() % static_cast<std::uint64_t>(limit)); }
  bool Chance() { return Below(2) == 0; }
  std::string OneOf(const std::vector<std::string>& words) {
    return words[static_cast<std::size_t>(Below(static_cast<int>(words.size())))];
  }
  std::string Size() { return OneOf({"small", "large"}); }
  std::string Thing() { return OneOf(things_); }

  std::string World() {
    things_ = {"a", "b", "c"};
    things_.resize(static_cast<std::size_t>(1 + Below(3)));
    std::string text =
        "[world]\nkind = \"scripted\"\nhand = { entity = \"h\", position = " + std::to_string(Below(4)) +
        " }\nobjects = [\n";
    for (const std::string& thing : things_) {
      text += "  { entity = \"" + thing + "\", position = " + std::to_string(Below(5) * 5) +
              ", properties = { size = \"" + Size() + "\", shape = \"" + OneOf({"cube", "sphere"}) + "\" }";
      if (Below(4) == 0) text += ", speed = " + std::to_string(Below(5) * 10 - 20);
      text += " },\n";
    }
    text += "]\ncommands = [\n  { name = \"move\", kind = \"move\" },\n";
    text += "  { name = \"grab\", kind = \"grab\", holds = { size = \"small\" }" + Failures() + " },\n";
    text += "  { name = \"clutch\", kind = \"grab\", holds = { size = \"large\" }" + Failures() + " },\n";
    return text + "  { name = \"release\", kind = \"release\"" + Failures() + " },\n]\n";
  }
  std::string Failures() {
    if (Below(3) > 0) return "";
    return ", fails = [{ after = " + std::to_string(Below(2)) + ", times = " + std::to_string(1 + Below(2)) +
           " }]";
  }

  std::string Reasoner() {
    std::string text = "[reasoner]\nmax_plan_depth = 4\nmax_simulation_nodes = 200\n";
    if (Below(3) == 0) text += "analogy_mode = \"openaera\"\n";
    if (Below(3) == 0) text += "value_roles = \"together\"\n";
    if (Below(3) == 0) text += "max_veto_ways = 2\n";
    if (Below(3) == 0) text += "analogy_min_psi = 0.3\n";
    if (Below(3) == 0) text += "primary_thz_ms = 300\nsecondary_thz_ms = 900\n";
    if (Below(3) == 0) text += "goal_induction = \"side_effects\"\nmax_prediction_chain = 0\n";
    return text;
  }

  std::string Lesson(int frame) {
    std::string text = "[[teacher]]\nframe = " + std::to_string(frame) + "\ncommand = ";
    if (Below(3) > 0) return text + "\"" + OneOf({"grab", "clutch", "release"}) + "\"\n";
    if (Chance()) return text + "\"move\"\nto = \"" + Thing() + "\"\n";
    return text + "\"(cmd move [h " + std::to_string(Below(11) - 5) + "])\"\n";
  }

  std::string Drive() {
    const std::string goal = Below(4) == 0 ? "position " + std::to_string(Below(5) * 5)
                                           : "holding [" + (Chance() ? Thing() : std::string()) + "]";
    return "[[drives]]\ntitle = \"" + goal + "\"\ngoal = \"(mk.val h " + goal +
           ")\"\nframes = " + std::to_string(1 + Below(5)) + "\n";
  }

  std::mt19937_64 random_;
  std::vector<std::string> things_;
};

}  // namespace

std::map<std::string, std::string> AnyScenario(std::uint64_t seed) {
  return {{"scenario.toml", Maker(seed).Make()}, {"seed.replicode", kSeed}};
}

}  // namespace aerascope
