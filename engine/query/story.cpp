#include "engine/query/story.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/model_history.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

constexpr std::size_t kMostNamed = 3;      // ids in brackets; the others are counted
constexpr std::size_t kMostSentences = 2;  // of one kind in one frame; the others are counted

std::string Counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string IdsOf(const std::vector<ModelId>& models) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < models.size(); ++i) {
    // Four are named rather than three and "1 more".
    if (i == kMostNamed && models.size() > kMostNamed + 1) {
      ids.push_back(std::to_string(models.size() - i) + " more");
      break;
    }
    ids.push_back(IdText(models[i]));
  }
  return InWords(ids);
}

std::string CountedVetoes(std::size_t count) {
  return count == 1 ? "a veto" : Counted(count, "veto", "vetoes");
}

// What one frame brought, sorted by what it is.
struct FrameDraft {
  std::vector<EventId> failures;
  std::vector<EventId> refused;  // commands that the world did not do
  std::vector<EventId> missed;
  std::vector<EventId> reached;
  std::vector<ModelId> given_up;
  std::vector<ModelId> phased_out;
  std::vector<ModelId> unmet;  // phased out since nothing was met that they are about
  std::vector<ModelId> back;
  EventId state_changed;
  std::vector<ModelId> vetoes;  // learned from a failure
  std::vector<EventId> analogies;
  std::vector<EventId> confirmed;     // of models made by analogy
  std::vector<ModelId> contradicted;  // vetoes that were wrong
  std::string contradiction;          // "h holding [] came true"
  std::vector<ModelId> learned;
  std::vector<EventId> not_again;  // an analogy that failed before
  EventId teacher;
  std::map<MomentKind, EventId> first;  // of each kind
};

class Storyteller {
 public:
  Storyteller(const Run& run, const EpisodeSummary& summary)
      : run_(run), knowledge_(run.final_knowledge()), summary_(summary) {}

  std::vector<StoryMoment> Tell() {
    NoteOutcomes();
    NoteKnowledge();
    NoteStates();
    NoteEvidence();
    NoteAnalogies();
    NoteCommands();
    std::vector<StoryMoment> story;
    for (const auto& [frame, draft] : drafts_) {
      if (draft.first.empty()) continue;
      const auto& [kind, event] = *draft.first.begin();
      StoryMoment moment{frame, kind, event, SentencesOf(draft)};
      story.push_back(std::move(moment));
    }
    return story;
  }

 private:
  // The draft of the frame in which the event lies; null where the run has no frames.
  FrameDraft* DraftOf(EventId event) {
    const Event* found = run_.Find(event);
    if (found == nullptr) return nullptr;
    const std::optional<std::size_t> frame = run_.FrameAt(found->time);
    return frame ? &drafts_[*frame] : nullptr;
  }
  FrameDraft* Note(MomentKind kind, EventId event) {
    FrameDraft* draft = DraftOf(event);
    if (draft == nullptr) return nullptr;
    EventId& first = draft->first.emplace(kind, event).first->second;
    first = std::min(first, event);
    return draft;
  }

  void NoteOutcomes() {
    for (const PredictionRecordOfRun& prediction : summary_.predictions) {
      if (prediction.outcome != Outcome::kFailed) continue;
      if (FrameDraft* draft = Note(MomentKind::kFailure, prediction.outcome_event))
        draft->failures.push_back(prediction.outcome_event);
    }
    for (const DriveOutcome& drive : summary_.drives) {
      if (drive.outcome == Outcome::kOpen) continue;
      const bool reached = drive.outcome == Outcome::kReached;
      FrameDraft* draft =
          Note(reached ? MomentKind::kGoalReached : MomentKind::kGoalFailed, drive.outcome_event);
      if (draft != nullptr) (reached ? draft->reached : draft->missed).push_back(drive.outcome_event);
    }
  }

  void NoteKnowledge() {
    for (const ModelId id : summary_.learned) {
      const ModelRecord* record = knowledge_.Find(id);
      // What was made by analogy is told by the comparison.
      if (record == nullptr || record->origin == Origin::kAnalogy) continue;
      FrameDraft* draft = Note(MomentKind::kLearned, record->event);
      if (draft == nullptr) continue;
      const bool veto = record->origin == Origin::kPredictionFailure && IsVeto(run_, id);
      (veto ? draft->vetoes : draft->learned).push_back(id);
    }
  }

  void NoteStates() {
    for (const EventId id : run_.OfKind<ModelStateChanged>()) {
      const auto& changed = *run_.FindBody<ModelStateChanged>(id);
      // What is given says nothing about the run, and what is forgotten changes nothing that is used.
      if (run_.Find(id)->simulation.valid() || changed.reason == StateChangeReason::kGiven ||
          changed.reason == StateChangeReason::kForgotten)
        continue;
      FrameDraft* draft = Note(MomentKind::kStateChanged, id);
      if (draft == nullptr) continue;
      switch (changed.after) {
        case ModelState::kActive:
          draft->back.push_back(changed.model);
          break;
        case ModelState::kPhasedOut:
          (changed.reason == StateChangeReason::kTimedOut ? draft->unmet : draft->phased_out)
              .push_back(changed.model);
          break;
        case ModelState::kDeleted:
          draft->given_up.push_back(changed.model);
          break;
      }
    }
  }

  void NoteEvidence() {
    for (const ModelHistory& history : Histories(run_)) {
      const ModelRecord* record = knowledge_.Find(history.model);
      if (record == nullptr || !IsRequirement(record->model)) continue;
      for (const ConfidenceStep& step : history.steps) {
        if (!step.success) continue;
        if (*step.success && record->origin == Origin::kAnalogy) {
          if (FrameDraft* draft = DraftOf(step.event)) draft->confirmed.push_back(step.event);
        } else if (!*step.success && IsVeto(run_, history.model)) {
          FrameDraft* draft = Note(MomentKind::kAside, step.event);
          if (draft == nullptr) continue;
          draft->contradicted.push_back(history.model);
          if (draft->contradiction.empty()) draft->contradiction = step.reason;
        }
      }
    }
  }

  void NoteAnalogies() {
    std::set<std::pair<ModelId, std::string>> failed_before;  // the analogy, and what it was wanted for
    for (const AnalogyOfRun& analogy : summary_.analogies) {
      if (analogy.made_knowledge) {
        if (FrameDraft* draft = Note(MomentKind::kAnalogy, analogy.event))
          draft->analogies.push_back(analogy.event);
      } else if (analogy.compared->verdict == AnalogyVerdict::kBlackListed) {
        const std::string told = SentenceOf(run_, *run_.Find(analogy.event));
        if (!failed_before.emplace(analogy.compared->requirement, told).second) continue;
        if (FrameDraft* draft = Note(MomentKind::kAside, analogy.event))
          draft->not_again.push_back(analogy.event);
      }
    }
  }

  void NoteCommands() {
    for (const EventId id : run_.OfKind<CommandRefused>()) {
      if (run_.Find(id)->simulation.valid()) continue;
      if (FrameDraft* draft = Note(MomentKind::kAside, id)) draft->refused.push_back(id);
    }
    // The first command of each stretch in which the teacher commands.
    const Commander* before = nullptr;
    const std::vector<IssuedCommand> commands = CommandsOf(run_);
    for (const IssuedCommand& command : commands) {
      const bool takes_over = before == nullptr || *before != command.by;
      before = &command.by;
      if (!takes_over || command.by != Commander::kTeacher) continue;
      if (FrameDraft* draft = Note(MomentKind::kAside, command.event)) draft->teacher = command.event;
    }
  }

  // ------------------------------------------------------------------------------------------------------------
  // words

  std::vector<std::string> SentencesOf(const FrameDraft& draft) const {
    std::vector<std::string> sentences;
    AddSome(draft.failures, "more did not come true", &sentences);
    AddSome(draft.refused, "more commands were not done", &sentences);
    AddSome(draft.missed, "more missed", &sentences);
    AddSome(draft.reached, "more reached", &sentences);
    if (!draft.contradicted.empty()) sentences.push_back(OfContradiction(draft));
    AddModels("Given up", draft.given_up, &sentences);
    AddModels("Phased out after failures", draft.phased_out, &sentences);
    AddModels("Phased out, not met for long", draft.unmet, &sentences);
    AddModels("In use again", draft.back, &sentences);
    if (!draft.vetoes.empty()) sentences.push_back(OfVetoes(draft.vetoes, draft.failures.size()));
    for (std::size_t i = 0; i < draft.analogies.size() && i < kMostSentences; ++i)
      sentences.push_back(OfAnalogy(draft.analogies[i]));
    if (draft.analogies.size() > kMostSentences)
      sentences.push_back(std::to_string(draft.analogies.size() - kMostSentences) + " more by analogy.");
    if (!draft.confirmed.empty())
      sentences.push_back("The analogy was right: " + Told(draft.confirmed.front()));
    AddModels("Learned", draft.learned, &sentences);
    if (!draft.not_again.empty()) sentences.push_back("Not tried again: " + Told(draft.not_again.front()));
    if (draft.teacher.valid()) sentences.push_back(Told(draft.teacher));
    return sentences;
  }

  std::string Told(EventId event) const { return SentenceOf(run_, *run_.Find(event)); }

  void AddSome(const std::vector<EventId>& events, const std::string& more,
               std::vector<std::string>* sentences) const {
    for (std::size_t i = 0; i < events.size() && i < kMostSentences; ++i)
      sentences->push_back(Told(events[i]));
    if (events.size() > kMostSentences)
      sentences->push_back(std::to_string(events.size() - kMostSentences) + " " + more + ".");
  }

  // "Given up: grab_type_1 a cube (mdl_80), made by analogy; 2 vetoes (mdl_96 and mdl_98)."
  void AddModels(const std::string& what, const std::vector<ModelId>& models,
                 std::vector<std::string>* sentences) const {
    if (models.empty()) return;
    std::vector<ModelId> vetoes;
    std::vector<std::string> parts;
    std::size_t more = 0;
    for (const ModelId id : models) {
      const ModelRecord* record = knowledge_.Find(id);
      if (IsVeto(run_, id)) {
        vetoes.push_back(id);
      } else if (parts.size() == kMostNamed) {
        ++more;
      } else {
        parts.push_back(TitleOf(knowledge_, id) + " (" + IdText(id) + ")" +
                        (record != nullptr && record->origin == Origin::kAnalogy ? ", made by analogy" : ""));
      }
    }
    if (more > 0) parts.push_back(Counted(more, "more model", "more models"));
    if (!vetoes.empty())
      parts.push_back(CountedVetoes(vetoes.size()) + " against " + WhatIsVetoed(run_, vetoes.front()) + " (" +
                      IdsOf(vetoes) + ")");
    sentences->push_back(what + ": " + Join(parts, "; ") + ".");
  }

  std::string OfVetoes(const std::vector<ModelId>& vetoes, std::size_t failures) const {
    const std::string source = failures == 1 ? "it" : failures == 0 ? "a failure" : "them";
    const std::string what = WhatIsVetoed(run_, vetoes.front());
    const bool alike = std::all_of(vetoes.begin(), vetoes.end(),
                                   [&](ModelId veto) { return WhatIsVetoed(run_, veto) == what; });
    return (vetoes.size() == 1 ? "A veto" : CountedVetoes(vetoes.size())) + " learned from " + source +
           (alike ? ", against " : ", first against ") + what + " (" + IdsOf(vetoes) + ").";
  }

  std::string OfContradiction(const FrameDraft& draft) const {
    const std::string vetoes = CountedVetoes(draft.contradicted.size()) + " denied";
    const std::string ids = " (" + IdsOf(draft.contradicted) + ").";
    return (draft.contradiction.empty() ? "Right was what " : draft.contradiction + ", which ") + vetoes +
           ids;
  }

  std::string OfAnalogy(EventId event) const {
    const auto& compared = *run_.FindBody<AnalogyCompared>(event);
    return "By analogy: " + TitleOf(knowledge_, compared.result_requirement) + ". " + Told(event);
  }

  const Run& run_;
  const KnowledgeBase& knowledge_;
  const EpisodeSummary& summary_;
  std::map<std::size_t, FrameDraft> drafts_;  // by frame
};

}  // namespace

bool IsVeto(const Run& run, ModelId model) {
  const ModelRecord* record = run.final_knowledge().Find(model);
  return record != nullptr && KindOf(record->model) == ModelKind::kStrongRequirement;
}

std::string WhatIsVetoed(const Run& run, ModelId veto) {
  static constexpr std::string_view kVeto = "veto: ";
  std::string title = TitleOf(run.final_knowledge(), veto);
  if (title.starts_with(kVeto)) title.erase(0, kVeto.size());
  if (const std::size_t when = title.rfind(", seen "); when != std::string::npos) title.resize(when);
  return title;
}

std::vector<StoryMoment> StoryOf(const Run& run, const EpisodeSummary& summary) {
  return Storyteller(run, summary).Tell();
}

}  // namespace aerascope
