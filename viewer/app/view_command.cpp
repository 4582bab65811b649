// aerascope view: one view of an episode as SVG or PNG, for a paper or a review.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/text.h"
#include "engine/query/goal_tree.h"
#include "viewer/app/commands.h"
#include "viewer/app/file_output.h"
#include "viewer/app/moment.h"
#include "viewer/app/pictures.h"
#include "viewer/app/terminal.h"
#include "viewer/draw/analogy_drawing.h"
#include "viewer/draw/png.h"
#include "viewer/draw/tree_drawing.h"
#include "viewer/draw/views.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  std::string what;
  std::optional<std::string> of;
  std::optional<std::string> at;
  std::string camera;
  std::optional<int> depth;
  std::string output;
  bool dark = false;
  double scale = 2;
};

// What a view is asked for, understood.
struct Asked {
  std::optional<ObjectId> object;
  std::optional<Time> at;
  Theme theme;
};

// The model that an object stands for: itself, or the requirement model on a composite state.
Result<ModelId> ModelMeant(const Run& run, const ObjectId& object) {
  if (const auto* model = std::get_if<ModelId>(&object)) return *model;
  if (const auto* state = std::get_if<CompositeStateId>(&object)) {
    for (const auto& [id, record] : run.final_knowledge().models()) {
      if (RequiredState(record.model) == *state) return id;
    }
  }
  return Error{IdText(object) + " is not a model, nor a composite state that a requirement model asks for"};
}

// The event that a question about an object is about: where it came to be.
Result<EventId> EventMeant(const Run& run, const std::optional<ObjectId>& object) {
  if (!object)
    return Error{"say with --of what the question is about: an event (#214), mdl_14, goal_7, pred_9"};
  return run.CreationOf(*object);
}

Result<std::string> DrawMoment(const Run& run, const Asked& asked, const std::string& camera_text) {
  auto pictures = EpisodePictures::Open(run);
  if (!pictures) return pictures.error();
  if (!pictures->can_draw()) return Error{pictures->trouble()};
  auto camera = ParseCamera(pictures->model(), camera_text);
  if (!camera) return camera.error();
  // What is said is what was seen as a frame began.
  const Time last = run.frames().empty() ? run.end() : run.frames().back().interval.after;
  auto frame = pictures->DrawFrame(asked.at.value_or(last), *camera, {1920, 1080});
  if (!frame) return frame.error();
  return MomentSvg(run, *frame, asked.theme);
}

// An option that a view has no use for is a slip, and said so.
Status HasUseFor(const Options& options) {
  const auto only = [&](bool given, const std::string& name,
                        const std::vector<std::string>& views) -> Status {
    if (!given || std::find(views.begin(), views.end(), options.what) != views.end()) return Ok();
    return Error{name + " is for " + Join(views, ", ") + "; leave it out with --what " + options.what};
  };
  if (Status fine = only(options.of.has_value(), "--of", {"graph", "analogy", "why", "led-to", "curves"});
      !fine)
    return fine;
  if (Status fine = only(options.at.has_value(), "--at", {"graph", "moment"}); !fine) return fine;
  if (Status fine = only(options.depth.has_value(), "--depth", {"why", "led-to"}); !fine) return fine;
  return only(!options.camera.empty(), "--camera", {"moment"});
}

Result<std::string> Draw(const Run& run, const Options& options, const Asked& asked) {
  if (options.what == "lanes") return LanesSvg(run, asked.theme);
  if (options.what == "goals") return GoalTreeSvg(run, MakeGoalTree(run), asked.theme);
  if (options.what == "moment") return DrawMoment(run, asked, options.camera);
  if (options.what == "analogy") {
    auto comparison = FindComparison(run, asked.object);
    if (!comparison) return comparison.error();
    return AnalogySvg(run, *comparison, asked.theme);
  }
  if (options.what == "why" || options.what == "led-to") {
    auto event = EventMeant(run, asked.object);
    if (!event) return event.error();
    const bool why = options.what == "why";
    return CauseTreeSvg(run, *event, why ? CauseDirection::kWhy : CauseDirection::kLedTo, asked.theme,
                        options.depth);
  }
  ModelId chosen;
  if (asked.object) {
    auto model = ModelMeant(run, *asked.object);
    if (!model) return model.error();
    chosen = *model;
  }
  if (options.what == "curves") {
    return CurvesSvg(run, chosen.valid() ? std::vector<ModelId>{chosen} : std::vector<ModelId>{},
                     asked.theme);
  }
  return KnowledgeViewSvg(run, asked.at.value_or(run.end()), chosen, asked.theme);
}

int MakeView(const Options& options) {
  const std::string ending = std::filesystem::path(options.output).extension().string();
  const bool png = ending == ".png";
  if (!png && !ending.empty() && ending != ".svg")
    return Fail("the view's file must end in .svg or .png, or be - for SVG on standard output; found " +
                options.output);
  if (Status fine = HasUseFor(options); !fine) return Fail(fine.error());
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  Asked asked;
  asked.theme = options.dark ? DarkTheme() : LightTheme();
  if (options.of) {
    auto object = run->FindObject(*options.of);
    if (!object) return Fail(object.error());
    asked.object = *object;
  }
  if (options.at) {
    auto at = ParseMoment(options.at, *run);
    if (!at) return Fail(at.error());
    asked.at = *at;
  }
  if (Status fine = CheckWritable(options.output); !fine) return Fail(fine.error());
  auto drawing = Draw(*run, options, asked);
  if (drawing && png) drawing = SvgToPng(*drawing, options.scale);
  if (!drawing) return Fail(drawing.error());
  if (Status written = WriteFile(options.output, *drawing); !written) return Fail(written.error());
  if (options.output != "-") std::printf("%s\n", options.output.c_str());
  return kDone;
}

}  // namespace

void AddViewCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("view", "Draw one view of an episode as SVG or PNG, for a paper or a review");
  command->add_option("episode", options->episode, "The episode file")->required();
  command
      ->add_option(
          "--what", options->what,
          "graph: what was known; analogy: a known triad beside the one made from it (the paper's Figure 3); "
          "why, led-to: causes and effects; curves: how sure it was; lanes: what happened when; goals: what "
          "was wanted; moment: a picture and its sentence")
      ->required()
      ->check(CLI::IsMember({"graph", "analogy", "why", "led-to", "curves", "lanes", "goals", "moment"}));
  command->add_option(
      "--of", options->of,
      "What graph, analogy, why, led-to or curves is about: mdl_14, cst_12, #214, goal_7, pred_9");
  command->add_option(
      "--at", options->at,
      "The moment of graph and moment: 3.2s, 700ms; default: the end, of moment the last frame");
  command
      ->add_option("--depth", options->depth,
                   "Of why and led-to: how many steps to go from what is asked about; default: as far as the "
                   "picture stays readable")
      ->check(CLI::Range(1, 1000));
  command->add_option("--camera", options->camera, "Of moment: a camera, as in the report");
  command
      ->add_option("-o,--output", options->output,
                   "The file to write, .png or else SVG; - is SVG on standard output")
      ->required();
  command->add_flag("--dark", options->dark, "Light on dark");
  command->add_option("--scale", options->scale, "Pixels of the PNG for each unit of the drawing")
      ->check(CLI::Range(0.25, 8.0))
      ->capture_default_str();
  command->callback([=] { *chosen = [=] { return MakeView(*options); }; });
}

}  // namespace aerascope
