#include <fmt/format.h>

#include "solver/app/manual/command_page.hpp"

namespace snug::app {

namespace {

/// Text for troff: backslashes and signs at the beginning of a line would be its own, and a hyphen in an option is a minus.
std::string troff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) result += "\\&";
    if (c == '\\') result += "\\e";
    else if (c == '-') result += "\\-";
    else result += c;
  }
  return result;
}

/// A word for a heading or an argument of a request.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char c : troff(text)) result += c == '"' ? std::string("\\(dq") : std::string(1, c);
  return "\"" + result + "\"";
}

std::string rows(const std::vector<OptionPage>& options) {
  std::string text;
  for (const OptionPage& one : options)
    if (one.names.back() != "--help") text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", troff(written(one)), troff(told(one)));
  return text;
}

std::string section(const CommandPage& page) {
  std::string text = fmt::format(".SS {}\n{}\n", quoted(usage(page)), troff(page.summary));
  text += rows(page.arguments) + rows(page.options);
  return page.footer.empty() ? text : text + ".PP\n" + troff(page.footer) + "\n";
}

}  // namespace

std::string manual_page(const std::vector<CommandPage>& pages, const std::string& version) {
  const CommandPage& program = pages.front();
  std::string text = fmt::format(".\\\" Made by snug man.\n.TH SNUG 1 \"\" {} \"User Commands\"\n.SH NAME\nsnug \\- pressure, deformation and comfort of garments on bodies\n", quoted("snug " + version));
  text += ".SH SYNOPSIS\n\\fBsnug\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...\n.SH DESCRIPTION\n" + troff(program.summary) +
          " A \\fIcase\\fR is a folder with a file case.toml and the tables that it names.\n"
          "\\fBsnug new\\fR makes one, \\fBsnug check\\fR says what is in it, \\fBsnug run\\fR solves it and \\fBsnug explain\\fR tells what a key of it means.\n"
          ".PP\nEvery command takes \\fB\\-\\-json\\fR: one JSON document on standard output in place of lines, numbers in SI with the unit at the end of the key.\n"
          "On a terminal lines are wrapped to its width; anywhere else a record is one line.\n";
  text += ".SH COMMANDS\n";
  for (std::size_t n = 1; n < pages.size(); ++n) text += section(pages[n]);
  text += ".SH EXIT STATUS\n" + troff(program.footer) + "\n";
  text += ".SH ENVIRONMENT\n"
          ".TP\n\\fBSNUG_LIBRARY\\fR\nfile of the library of fabrics, tissues and recorded runs (else snug/library.db in your data folder)\n"
          ".TP\n\\fBSNUG_RECORD\\fR\noff: runs are not recorded\n"
          ".TP\n\\fBCOLUMNS\\fR\nwidth of the terminal\n";
  text += ".SH EXAMPLES\n.nf\nsnug new mine \\-\\-like calf\\-sleeve\nsnug check mine\nsnug run mine\nsnug size mine \\-\\-target \"Ankle = 20 mmHg\"\nsource <(snug completion bash)\n.fi\n";
  return text;
}

}  // namespace snug::app
