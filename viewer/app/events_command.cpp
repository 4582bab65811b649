// aerascope events: the log, one event a line.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <sstream>

#include "engine/base/text.h"
#include "exporters/events/events.h"
#include "viewer/app/commands.h"
#include "viewer/app/file_output.h"
#include "viewer/app/moment.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  std::string kind;
  std::optional<std::string> from;
  std::optional<std::string> to;
  std::string format = "text";
};

int PrintEvents(const Options& options) {
  EventFilter filter;
  if (!options.kind.empty()) {
    const std::size_t kind = KindOfName(options.kind);
    if (kind == kEventKinds) {
      const std::string closest = ClosestWord(options.kind, EventKindNames());
      return Fail("there is no kind of event '" + options.kind + "'" +
                  (closest.empty() ? "; known are " + Join(EventKindNames(), ", ")
                                   : "; did you mean '" + closest + "'?"));
    }
    filter.kind = kind;
  }
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  if (options.from) {
    auto from = ParseMoment(options.from, *run);
    if (!from) return Fail(from.error());
    filter.from = *from;
  }
  if (options.to) {
    auto to = ParseMoment(options.to, *run);
    if (!to) return Fail(to.error());
    filter.to = *to;
  }
  if (filter.from > filter.to)
    return Fail("--from " + *options.from + " lies behind --to " + *options.to +
                ", so no event can lie between them; give the earlier moment to --from");
  std::ostringstream text;
  const Status status = options.format == "ndjson" ? WriteEventsNdjson(*run, filter, text)
                                                   : WriteEventsText(*run, filter, text);
  if (!status) return Fail(status.error());
  if (Status written = WriteFile("-", text.str()); !written) return Fail(written.error());
  return kDone;
}

}  // namespace

void AddEventsCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("events", "The event log, one event a line");
  command->add_option("episode", options->episode, "The episode file")->required();
  command->add_option("--kind", options->kind, "Only events of this kind, e.g. AnalogyCompared");
  command->add_option("--from", options->from, "Only events at or after this moment");
  command->add_option("--to", options->to, "Only events up to this moment");
  command->add_option("--format", options->format, "text or ndjson")
      ->check(CLI::IsMember({"text", "ndjson"}))
      ->capture_default_str();
  command->callback([=] { *chosen = [=] { return PrintEvents(*options); }; });
}

}  // namespace aerascope
