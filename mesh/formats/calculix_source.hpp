// The lines of an input of CalculiX or Abaqus with the files that it includes.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

/// Where *INCLUDE may look: files named from `folder` (the included one's own goes on from there), none outside `root`.
struct IncludeRules {
  std::filesystem::path folder = {}, root = {};  ///< both empty: nothing is included
};

class InpSource {
 public:
  InpSource(const std::string& text, const std::string& file, IncludeRules rules);

  /// The next line that is neither empty nor a comment; keywords whose line ends in a comma go on with the next one.
  bool next(std::string_view& line);
  /// Of the last line.
  int number() const { return open_.back().line; }
  const std::string& file() const { return *open_.back().file; }
  bool in_main_file() const { return open_.size() == 1; }
  /// Goes on with the file, then comes back. Reports files outside the root, missing ones and endless inclusion.
  void include(const std::string& name, const input::Location& where, input::Diagnostics& diagnostics);

 private:
  struct Open {
    LineSource lines;
    const std::string* file;
    std::filesystem::path folder;
    int line = 0;
  };
  bool raw(std::string_view& line);

  IncludeRules rules_;
  std::deque<std::string> kept_;  ///< texts and names of files, joined lines
  std::vector<Open> open_;
  int included_ = 0;
};

}  // namespace snug::mesh
