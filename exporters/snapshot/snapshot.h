// A snapshot is the canonical text of a knowledge base: equal knowledge gives equal bytes, whatever its
// numbers, names of variables and order of learning. Kept in a file, it is the expectation of a test.
//
// One item a block: its kind, its alias (C1, C2 ... composite states, M1, M2 ... models, in the order of the
// text), the start of its content hash, then what it says, one line each. Deleted models are left out; times,
// ids and, unless asked for, evidence too. Order: kind, words, hash.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/kb/knowledge_base.h"

namespace aerascope {

struct SnapshotOptions {
  bool evidence = false;  // confidence and counts of each model are part of it
};

std::string SnapshotText(const KnowledgeBase& knowledge, const SnapshotOptions& options = {});

// What a snapshot expects and what there is. Items are found again by content, so that an item more or less
// does not make the others differ, although all aliases behind it are others.
struct SnapshotComparison {
  std::vector<std::string> missing;  // kind and words of items that only the stored text has
  std::vector<std::string> added;    // that only the actual text has
  std::vector<std::string> changed;  // that both have, with other evidence, origin or state
  std::string difference;  // all of it for people: `-` missing, `+` new, `~` changed; empty if the same

  bool same() const { return difference.empty(); }
};

// Fails if one of the texts is not a snapshot; `stored_name` is what the stored one is called in the
// sentence.
Result<SnapshotComparison> CompareSnapshots(std::string_view stored, std::string_view actual,
                                            const std::string& stored_name);

// Whether a text begins as a snapshot does, of whatever version.
bool IsSnapshot(std::string_view text);

// Whether a snapshot was made with evidence; fails if the text is no snapshot.
Result<bool> SnapshotHasEvidence(std::string_view stored, const std::string& stored_name);

// Compares the knowledge with the snapshot in the file, under the options that stand in it. Writes nothing.
// Fails where there is no such file, or it is no snapshot.
Result<SnapshotComparison> TestSnapshot(const std::string& path, const KnowledgeBase& knowledge);

// Makes the snapshot of this knowledge the expectation: writes a file beside, then puts it in place. Folders
// are made. Fails where something stands that is neither a snapshot nor empty, and leaves that as it is.
Status AcceptSnapshot(const std::string& path, const KnowledgeBase& knowledge,
                      const SnapshotOptions& options = {});

}  // namespace aerascope
