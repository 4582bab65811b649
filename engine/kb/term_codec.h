// Terms as exact, compact text for storage and hashing: what the episode file and event digests hold.
//
// Unlike ToText, every kind is told apart and nothing is lost: `(mk.val @h position (vec2 0.1 0.2))` has an
// entity h and an ontology symbol position. Grammar: @name entity, name ontology symbol, 0.1 number, t100000
// instant (µs), d100000 duration (µs), "..." string, #t #f bools, $3 variable, : wildcard, [..] set, (head
// ..) struct, ~c12 composite state, ~m14 model, nil. A name with other characters than letters, digits and
// _.-+*/<>=|:? is written |..| with \xNN escapes.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/kb/term.h"

namespace aerascope {

std::string Encode(const Term& term);
// The same into an existing text.
void AppendEncoded(const Term& term, std::string* out);
// As Encode(Term::String(text)).
void AppendEncodedString(std::string_view text, std::string* out);

// Reads exactly what Encode writes; an error names the byte offset.
Result<Term> DecodeTerm(std::string_view text);

}  // namespace aerascope
