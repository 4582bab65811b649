// Columns of texts that are much alike, as bytes. "h at 60, 154.1 s to 154.2 s" is the form "h at #, # s to #
// s" and the numbers 60, 154.1 and 154.2; forms are few, and the numbers of one form, one below the other,
// move little, so a general compression finds both. The page's text_columns.js reads them back.
//
// Bytes: how many bytes of forms follow, and those: UTF-8, each form ended by a line feed, with the character
// U+0001 where a number stands. Then column after column, each of as many rows as its reader knows of:
//   forms    for each row: 0 for nothing, else the position of its form among the forms, from 1
//   numbers  for each form in the column, in the order of their first rows, for each place of a number in it:
//            unsigned 2 * decimals + (1 if counted from the row's own number), then for each row with this
//            form a signed number: what it is above the row's number, or above the number in the row with
//            this form before (the first: above 0). It is in units of the last decimal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/page/columns.h"

namespace aerascope {

// A row of a column.
struct TextCell {
  std::int64_t row = 0;  // the row's own number, of an event: texts often name it, or one shortly before
  std::optional<std::string> text;
};

class TextColumns {
 public:
  void Add(const std::vector<TextCell>& column);
  std::string bytes() const;

 private:
  std::size_t FormNumber(const std::string& form);

  std::map<std::string, std::size_t, std::less<>> numbers_;
  std::string forms_;
  ColumnWriter columns_;
};

}  // namespace aerascope
