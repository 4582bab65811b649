// Reads Replicode: entities, ontology symbols, facts, composite states and models (the language of OpenAERA's
// seeds).
//
// Names are declared before they are used. Views, output groups and trailing fields such as saliency are
// accepted and have no meaning here. Programs and groups are refused: in aerascope the teacher's commands and
// the drives stand in the scenario file. Every error says file:line:column, what was expected and what was
// found.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/time.h"
#include "engine/replicode/seed.h"

namespace aerascope {

struct ReplicodeOptions {
  // The value of the word sampling_period.
  Duration sampling_period = Milliseconds(100);
  // Entities and ontology symbols that the text may use without declaring them.
  std::vector<Term> known_symbols;
  // For OpenAERA's own seeds and dumps: what is not knowledge is passed over and counted, what cannot be read
  // becomes an entry of `problems`, and command names need no declaration.
  bool foreign = false;
};

Result<SeedKnowledge> ReadReplicode(std::string_view text, const std::string& file,
                                    const ReplicodeOptions& options = {});

// Reads one payload without variables, such as (mk.val h holding [s1]) or (cmd release [h]). `start` is where
// the text begins, for messages.
Result<Term> ReadPayload(std::string_view text, const SourceLocation& start, const ReplicodeOptions& options);

}  // namespace aerascope
