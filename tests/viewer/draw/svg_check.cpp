#include "tests/viewer/draw/svg_check.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace aerascope {

Run PaperRun(const PaperEpisodeOptions& options) {
  EpisodeFile file;
  file.events = PaperEpisode(options);
  file.complete = options.last_frame == 15;
  file.header.program_version = "aerascope 0.1.0";
  file.stored_digest = HashOf("paper");
  return Run::FromEvents(std::move(file));
}

Run LongRun(int triads, bool with_veto) {
  EpisodeFile file;
  std::int64_t frame = 0;
  const auto emit = [&](EventBody body, std::vector<EventId> causes) {
    const EventId id{static_cast<std::int64_t>(file.events.size()) + 1};
    file.events.push_back({id, {frame * 1'000'000}, frame, {}, std::move(causes), std::move(body)});
    return id;
  };
  const EventId start = emit(EpisodeStarted{"A long run", "scripted", 1, 1'000'000, {}}, {});
  std::int64_t object = 0;
  ModelId causal;
  const auto pattern = [](Term payload) {
    return FactPattern{true, std::move(payload), Term::Variable(1), Term::Variable(2)};
  };
  for (int i = 0; i < triads; ++i) {
    ++frame;
    emit(FrameStarted{{{frame * 1'000'000}, {(frame + 1) * 1'000'000}}}, {});
    const std::string name = std::to_string(i);
    if (i % 3 == 0) {
      causal = ModelId{++object};
      Model model{causal, {}, {}, {}, {}, {}, {}};
      model.lhs = pattern(MakeCommand(Term::Ontology("do_" + name), {Term::Variable(0)}));
      model.rhs = pattern(MakeValue(Term::Variable(0), Term::Ontology("done_" + name), Term::Bool(true)));
      emit(ModelCreated{model, {1, 1}, false, Origin::kInduction, {}}, {start});
    }
    const CompositeStateId state{++object};
    emit(
        CompositeStateCreated{
            {state,
             {pattern(MakeValue(Term::Variable(0), Term::Ontology("ready_" + name), Term::Bool(true)))},
             {},
             {}},
            Origin::kInduction,
            {}},
        {start});
    Model requirement{ModelId{++object}, {}, {}, {}, {}, {}, {}};
    requirement.lhs = pattern(MakeIcst(state, {}, {Term::Variable(0)}));
    requirement.rhs = pattern(MakeImdl(causal, {}, {Term::Variable(0)}));
    requirement.rhs.positive = !(with_veto && i == 0);
    const EventId made = emit(ModelCreated{requirement, {1, 1}, false, Origin::kInduction, {}}, {start});
    emit(EvidenceUpdated{requirement.id, i % 2 == 0, {1, 1}, {i % 2 == 0 ? 2.0 : 1.0, 2}, false, false},
         {made});
  }
  emit(EpisodeEnded{frame, 0, 0}, {start});
  file.complete = true;
  return Run::FromEvents(std::move(file));
}

std::string WhatXmllintSays(const std::string& svg) {
  if (std::system("command -v xmllint >/dev/null 2>&1") != 0) return std::string(kNoXmllint);
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = testing::TempDir() + test->test_suite_name() + "." + test->name() + ".svg";
  std::ofstream(name, std::ios::binary) << svg;
  // The huge option is for pictures inside; nothing is fetched.
  FILE* pipe = popen(("xmllint --noout --nonet --huge '" + name + "' 2>&1").c_str(), "r");
  std::string said;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) said += static_cast<char>(c);
  const int status = pclose(pipe);
  std::remove(name.c_str());
  return status == 0 && said.empty() ? "" : "status " + std::to_string(status) + ": " + said;
}

std::size_t CountOf(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

}  // namespace aerascope
