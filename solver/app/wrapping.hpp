// Lines made to fit a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace snug::app {

/// Columns that a text of UTF-8 takes: characters, not bytes.
std::size_t columns_of(const std::string& text);

/// Each line of `text` that is wider than `width` columns is broken at blanks. What goes on stands below the last column of its row: what follows
/// two or more blanks begins a column; a line without columns goes on four blanks further in than it begins. A word wider than the terminal (a
/// path, a URL) stays whole, and so does a row whose last column begins beyond half of the width: that is a table. Width 0 leaves all as it is.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace snug::app
