#include "tests/support/large_scenario.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace aerascope {
namespace {

constexpr std::array<const char*, 3> kShapes = {"cube", "sphere", "cylinder"};
constexpr std::int64_t kLamps = 10;

// How much there is of everything, so that events and models come out as asked.
struct Sizes {
  std::int64_t classes = 0;  // sizes of things; of each a cube, a sphere and a cylinder
  std::int64_t grabs = 0;    // commands that hold things of one size; each is taught once
  std::int64_t presses = 0;  // commands that switch a lamp; each is taught once
  std::int64_t given = 0;    // actions known from elsewhere
};

// Measured: a frame has about 95 events, six more for each class of things, and each second switch that is
// known adds what its requirement model says in each frame.
Sizes SizesFor(const LargeScenarioOptions& options) {
  const std::int64_t frames = std::max<std::int64_t>(options.frames, 50);
  const std::int64_t wanted = options.events / frames;
  Sizes sizes;
  sizes.grabs = std::clamp<std::int64_t>(std::min(options.models / 40, frames / 12), 2, 40);
  const std::int64_t room = frames / 8;  // lessons that fit between the drives
  sizes.presses =
      std::clamp<std::int64_t>(std::min({options.models / 8, room, wanted - 100}), 2, 400) / 2 * 2;
  sizes.classes = std::clamp<std::int64_t>((wanted - 95 - sizes.presses * 2 / 5) / 6, 2, 40);
  // A grasp that was never taught for any thing of its size fails: half of the drives would be missed, and
  // too little carried over by analogy for a reader to be measured with.
  sizes.grabs = std::max(sizes.grabs, sizes.classes);
  const std::int64_t learned = 2 * (sizes.grabs + sizes.presses) + 2 * sizes.classes;
  sizes.given = std::max<std::int64_t>(options.models - learned, 0) * 2 / 5;  // five models for two of them
  return sizes;
}

std::string Numbered(const char* name, std::int64_t number) {
  return std::string(name) + "_" + std::to_string(number + 1);
}

struct Thing {
  std::string name;
  std::string shape;
  std::string size;
};

class Maker {
 public:
  explicit Maker(const LargeScenarioOptions& options)
      : options_(options), sizes_(SizesFor(options)), random_(options.seed) {
    for (const char* shape : kShapes) {
      for (std::int64_t i = 0; i < sizes_.classes; ++i)
        things_.push_back({Numbered(shape, i), shape, Numbered("size", i)});
    }
  }

  std::string Scenario() {
    std::string text = "title = \"A long day in the workshop\"\n";
    text +=
        "story = \"A hand is taught grasps and switches, carries them over by analogy, and watches a "
        "ball.\"\n";
    text += "sampling_period_ms = 100\nrandom_seed = " + std::to_string(options_.seed % 1000000);
    const std::string frames = std::to_string(options_.frames);
    text += "\nmin_frames = " + frames + "\nmax_frames = " + frames +
            "\n[seed]\nreplicode = \"seed.replicode\"\n";
    text += World();
    Timetable();
    return text + lessons_ + drives_;
  }

  std::string Seed() {
    std::string text = "h:(ent 1)\nmarble:(ent 1)\n";
    for (const Thing& thing : things_) text += thing.name + ":(ent 1)\n";
    for (std::int64_t i = 0; i < kLamps; ++i) text += Numbered("lamp", i) + ":(ent 1)\n";
    for (const char* word : {"essence", "shape", "size", "position", "speed", "holding", "kind", "lit",
                             "place", "stage", "hand", "round", "on", "off", "raw", "move", "release"})
      text += Symbol(word);
    for (const char* shape : kShapes) text += Symbol(shape);
    for (std::int64_t i = 0; i < sizes_.classes; ++i) text += Symbol(Numbered("size", i));
    for (std::int64_t i = 0; i < kLamps; ++i) text += Symbol(Numbered("lamp_kind", i));
    for (std::int64_t i = 0; i < sizes_.grabs; ++i) text += Symbol(Numbered("grab", i));
    for (std::int64_t i = 0; i < sizes_.presses; ++i) text += Symbol(Numbered("press", i));
    text += Property("h", "essence", "hand") + Property("marble", "shape", "round");
    for (const Thing& thing : things_)
      text += Property(thing.name, "shape", thing.shape) + Property(thing.name, "size", thing.size);
    for (std::int64_t i = 0; i < kLamps; ++i)
      text += Property(Numbered("lamp", i), "kind", Numbered("lamp_kind", i));
    text +=
        State("S0", {"H: essence hand", "H: position P:"}) + State("S4", {"C: size X:", "C: position P:"});
    for (std::int64_t i = 0; i < sizes_.given; ++i) text += GivenAction(i);
    return text;
  }

 private:
  std::size_t Below(std::size_t limit) { return static_cast<std::size_t>(random_() % limit); }

  static std::string Symbol(const std::string& name) { return name + ":(ont 1)\n"; }
  static std::string Property(const std::string& thing, const char* attribute, const std::string& value) {
    return "(fact (mk.val " + thing + " " + attribute + " " + value + " 1) 0s:0ms:0us GIGASEC 1 1)\n";
  }
  static std::string State(const std::string& label, const std::vector<std::string>& conditions) {
    std::string text = label + ":(cst [] []\n";
    for (const std::string& condition : conditions)
      text += "   (fact (mk.val " + condition + " :) T0: T1: : :)\n";
    return text + "|[] |[] [stdin] 1)\n";
  }

  // What is known of a kind of part that is not about: an action, when it works, and for every second one
  // when it does not.
  static std::string GivenAction(std::int64_t i) {
    const std::string number = std::to_string(i + 1);
    const std::string kind = "part_kind_" + number;
    const std::string stage = "stage_" + std::to_string(i % 40 + 1);
    const std::string tries = std::to_string(i % 7 + 1);
    std::string text = Symbol(kind) + Symbol("work_" + number);
    if (i < 40) text += Symbol(stage) + Symbol("bench_" + number);
    text += State("part_" + number,
                  {"C: kind " + kind, "C: place bench_" + std::to_string(i % 40 + 1), "C: stage raw"});
    text += "work_model_" + number + ":(mdl [raw (ti T0: T1:)] []\n   (fact (cmd work_" + number +
            " [C:] :) T2: T3: : :)\n   (fact (mk.val C: stage " + stage +
            " :) T4: T5: : :)\n[]\n   T4:(+ T0 sampling_period)\n   T5:(+ T1 sampling_period)\n"
            "[]\n   T0:(- T4 sampling_period)\n   T1:(- T5 sampling_period)\n   T2:(- T4 80ms)\n   T3:(- T5 "
            "100ms)\n"
            "[stdin] 1 " +
            tries + " 1 1 1)\n";
    text += Requirement("work_if_" + number, "part_" + number, "C:", "", "work_model_" + number, tries);
    if (i % 2 == 1) {
      text += Symbol("wet_" + number);
      text += State("wet_part_" + number, {"C: kind " + kind, "C: stage wet_" + number});
      text += Requirement("work_not_if_" + number, "wet_part_" + number, "C:", "|", "work_model_" + number,
                          tries);
    }
    return text;
  }
  static std::string Requirement(const std::string& label, const std::string& state,
                                 const std::string& arguments, const std::string& sign,
                                 const std::string& model, const std::string& tries) {
    return label + ":(mdl [] []\n   (fact (icst " + state + " [] [" + arguments +
           "] : :) T0: T1: : :)\n   (" + sign + "fact (imdl " + model +
           " [raw (ti T0: T1:)] [C: T2: T3:] : :) T0: T1: : :)\n|[] |[] [stdin] 0 " + tries + " 1 1 1)\n";
  }

  // The marble is far from everything, so that no place of it is another thing's place by chance.
  std::string World() {
    std::string text = "[world]\nkind = \"scripted\"\nhand = { entity = \"h\", position = 0 }\nobjects = [\n";
    text += "  { entity = \"marble\", position = -1000000, speed = 40, speed_changes = [" + Hits() + "] },\n";
    for (std::size_t i = 0; i < things_.size(); ++i)
      text += "  { entity = \"" + things_[i].name + "\", position = " + std::to_string(5 * (i + 1)) + " },\n";
    for (std::int64_t i = 0; i < kLamps; ++i)
      text += "  { entity = \"" + Numbered("lamp", i) + "\", state = { lit = \"off\" } },\n";
    text +=
        "]\ncommands = [\n  { name = \"move\", kind = \"move\" },\n  { name = \"release\", kind = "
        "\"release\" },\n";
    for (std::int64_t i = 0; i < sizes_.grabs; ++i)
      text += "  { name = \"" + Numbered("grab", i) + "\", kind = \"grab\", holds = { size = \"" +
              Numbered("size", i % sizes_.classes) + "\" } },\n";
    for (std::int64_t i = 0; i < sizes_.presses; ++i)
      text += "  { name = \"" + Numbered("press", i) +
              "\", kind = \"change\", argument = \"thing\", sets = { lit = \"" + (i % 2 == 0 ? "on" : "off") +
              "\" } },\n";
    return text + "]\n";
  }
  // Single hits, and now and then two in succession, which phase the law of motion out for a while.
  std::string Hits() {
    std::string text;
    std::int64_t speed = 40;
    const auto hit = [&](std::int64_t frame) {
      speed = speed > 0 ? -10 * static_cast<std::int64_t>(1 + Below(6))
                        : 10 * static_cast<std::int64_t>(1 + Below(6));
      text += (text.empty() ? "" : ", ") + std::string("{ frame = ") + std::to_string(frame) +
              ", speed = " + std::to_string(speed) + " }";
    };
    for (std::int64_t frame = 20; frame + 1 < options_.frames; frame += 120) {
      hit(frame);
      if (frame % 360 == 260) hit(frame + 1);
    }
    return text;
  }

  // First the grasps are taught, each on a cube. Then lessons in switching and drives take turns.
  void Timetable() {
    std::int64_t frame = 1;
    for (std::int64_t i = 0; i < sizes_.grabs; ++i) {
      Teach(frame++, "move", things_[static_cast<std::size_t>(i % sizes_.classes)].name);
      Teach(frame++, Numbered("grab", i));
      Teach(frame++, "release");
    }
    std::int64_t press = 0;
    for (std::int64_t round = 0; frame + 30 < options_.frames; ++round) {
      for (int i = 0; i < 6 && press < sizes_.presses; ++i, ++press)
        Teach(frame++,
              "(cmd " + Numbered("press", press) + " [" + Numbered("lamp", press / 2 % kLamps) + "])");
      for (int i = 0; i < 3; ++i) {
        const std::string thing = things_[Below(things_.size())].name;
        frame = Want(frame, "hold " + thing, "h holding [" + thing + "]", 5);
        frame = Want(frame, "hold nothing", "h holding []", 2);
      }
      // Nothing it knows leads there.
      if (round % 30 == 7) frame = Want(frame, "the marble at speed 777", "marble speed 777", 3);
      if (round % 40 == 19) {
        const std::string lamp = Numbered("lamp", static_cast<std::int64_t>(Below(kLamps)));
        frame = Want(frame, "light " + lamp, lamp + " lit on", 3);
      }
    }
  }
  void Teach(std::int64_t frame, const std::string& command, const std::string& to = "") {
    lessons_ += "[[teacher]]\nframe = " + std::to_string(frame) + "\ncommand = \"" + command + "\"\n";
    if (!to.empty()) lessons_ += "to = \"" + to + "\"\n";
  }
  std::int64_t Want(std::int64_t frame, const std::string& title, const std::string& goal,
                    std::int64_t frames) {
    drives_ += "[[drives]]\ntitle = \"" + title + "\"\ngoal = \"(mk.val " + goal +
               ")\"\nframe = " + std::to_string(frame) + "\nframes = " + std::to_string(frames) + "\n";
    return frame + frames;
  }

  LargeScenarioOptions options_;
  Sizes sizes_;
  std::mt19937_64 random_;
  std::vector<Thing> things_;
  std::string lessons_;
  std::string drives_;
};

}  // namespace

std::map<std::string, std::string> LargeScenario(const LargeScenarioOptions& options) {
  Maker maker(options);
  std::map<std::string, std::string> files;
  files["scenario.toml"] = maker.Scenario();
  files["seed.replicode"] = maker.Seed();
  return files;
}

}  // namespace aerascope
