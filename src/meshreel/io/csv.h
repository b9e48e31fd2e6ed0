/// Tables as text, one line a row: comma, semicolon or tab separated values.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshreel/base/limits.h"
#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel::io {

/// One row and the line of the file in which it begins, from 1.
struct CsvRow {
    std::uint64_t line = 0;
    std::vector<std::string> cells;
};

/// A header, and rows that have as many cells each.
struct Csv {
    char separator = ',';
    CsvRow header;
    std::vector<CsvRow> rows;
};

/// Reads a table as RFC 4180 has it: "cells in quotes" may hold separators, line ends and "" for a quote. Besides: the
/// separator is the one of tab, semicolon and comma that the header has most of, in that order where it is undecided; lines end
/// in LF or CR LF; blanks around a cell, empty lines and a byte order mark do not count.
/// @fails bad_input, naming line and column: no header, a column without a name or with another's, more or fewer cells
/// than the header, a quote that does not end or stands inside a cell, a control character, no row, too much for the limits.
Result<Csv> parse_csv(ByteView text, const DecodeLimits& limits = {});

} // namespace meshreel::io
