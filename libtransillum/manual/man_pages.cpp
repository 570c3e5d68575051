// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "man_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "transillum/scene.h"

namespace transillum::manual {
namespace {

/// Text for roff: hyphens are minus signs where they belong to options, and nothing is a request.
std::string escaped(const std::string& text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    const bool begins = k == 0 || text[k - 1] == '\n';
    if (begins && (c == '.' || c == '\'')) {
      result += "\\&";
    }
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// "\fB\-m\fR, \fB\-\-directions\fR \fIM\fR"
std::string heading(const Option& option) {
  std::string text;
  for (const std::string& name : option.names) {
    const bool is_argument = name[0] != '-';
    text += fmt::format("{}\\f{}{}\\fR", text.empty() ? "" : ", ", is_argument ? 'I' : 'B',
                        escaped(name));
  }
  if (option.takes_value() && option.names[0][0] == '-') {
    text += fmt::format(" \\fI{}\\fR", escaped(option.type));
  }
  return text;
}

std::string sentence(std::string text) {
  if (!text.empty() && text.back() != '.') {
    text += '.';
  }
  return text;
}

std::string list_of(const std::vector<Option>& options, const char* title) {
  if (options.empty()) {
    return {};
  }
  std::string text = fmt::format(".SH {}\n", title);
  for (const Option& option : options) {
    text += fmt::format(".TP\n{}\n{}\n", heading(option), escaped(sentence(option.description)));
  }
  return text;
}

std::string synopsis(const std::string& words, const Command& command) {
  std::string text = fmt::format(".SH SYNOPSIS\n\\fB{}\\fR", escaped(words));
  text += " [\\fIOPTIONS\\fR]";
  for (const Option& argument : command.arguments) {
    const std::string name = escaped(argument.names[0]) + (argument.repeats ? "..." : "");
    const std::string italic = fmt::format("\\fI{}\\fR", name);
    text += argument.required ? " " + italic : " [" + italic + "]";
  }
  return text + "\n";
}

std::string title(const std::string& page, const Introduction& introduction) {
  return fmt::format(".TH {} 1 {} \"transillum {}\" \"User Commands\"\n", escaped(upper(page)),
                     introduction.date, introduction.version);
}

/// Help texts keep their lines: tables of columns and examples.
std::string preformatted(const std::string& text) {
  return fmt::format(".nf\n{}\n.fi\n", escaped(text));
}

/// Notes and examples of a command's help.
std::string footer(const std::string& text) {
  const std::size_t example = text.find("Example");
  std::string notes = text.substr(0, example);
  while (!notes.empty() && std::isspace(static_cast<unsigned char>(notes.back()))) {
    notes.pop_back();
  }
  std::string result;
  if (!notes.empty()) {
    result += ".SH NOTES\n" + preformatted(notes);
  }
  if (example != std::string::npos) {
    std::string examples = text.substr(text.find(':', example) + 1);
    examples.erase(0, examples.find_first_not_of(" \n"));
    while (!examples.empty() && examples.back() == '\n') {
      examples.pop_back();
    }
    // Aligned under the first example in the help.
    const std::string indent = "\n" + std::string(9, ' ');
    for (std::size_t at = 0; (at = examples.find(indent, at)) != std::string::npos; ++at) {
      examples.replace(at, indent.size(), "\n");
    }
    result += ".SH EXAMPLES\n" + preformatted(examples);
  }
  return result;
}

std::string exit_status() {
  return ".SH EXIT STATUS\n"
         "0 success; 2 invalid arguments or input, with one line on standard error that says what "
         "and where;\n1 any other failure; 130 interrupted, after saving what there is.\n";
}

std::string see_also(const std::vector<std::string>& pages) {
  std::string text;
  for (const std::string& page : pages) {
    text += fmt::format("{}\\fB{}\\fR(1)", text.empty() ? "" : ",\n", escaped(page));
  }
  return ".SH SEE ALSO\n" + text + "\n";
}

std::string commands(const Program& program) {
  std::string text = ".SH COMMANDS\n";
  for (const Command& command : program.commands) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}; see \\fBtransillum\\-{}\\fR(1).\n", command.name,
                        escaped(command.summary), command.name);
  }
  return text;
}

std::string built_in() {
  std::string text = ".SH BUILT-IN SCENES\nParameters follow a colon, as in rooms:n=50,seed=2.\n";
  for (const BuiltInScene& scene : built_in_scenes()) {
    const std::string parameters =
        scene.parameters.empty() ? std::string() : fmt::format(" Parameters: {}", scene.parameters);
    text += fmt::format(".TP\n\\fB{}\\fR\n{}{}\n", escaped(scene.name),
                        escaped(sentence(scene.summary)), escaped(parameters));
  }
  return text;
}

ManPage page_of_command(const Program& program, const Command& command,
                        const Introduction& introduction) {
  ManPage page;
  page.name = program.name + "-" + command.name;
  std::string summary = command.summary;
  summary[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(summary[0])));
  page.text = title(page.name, introduction) +
              fmt::format(".SH NAME\n{} \\- {}\n", escaped(page.name), escaped(summary)) +
              synopsis(program.name + " " + command.name, command) +
              list_of(command.arguments, "ARGUMENTS") + list_of(command.options, "OPTIONS") +
              footer(command.footer) + exit_status() + see_also({program.name});
  return page;
}

}  // namespace

ManPage page_of_program(const Program& program, const Introduction& introduction) {
  ManPage page;
  page.name = program.name;
  std::string summary = program.self.summary;
  if (summary.ends_with('.')) {
    summary.pop_back();
  }
  page.text = title(page.name, introduction) +
              fmt::format(".SH NAME\n{} \\- {}\n", escaped(page.name), escaped(summary));
  page.text += program.commands.empty()
                   ? synopsis(program.name, program.self)
                   : fmt::format(
                         ".SH SYNOPSIS\n\\fB{}\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] "
                         "[\\fIARGUMENTS\\fR]\n",
                         escaped(program.name));
  page.text += ".SH DESCRIPTION\n";
  for (const std::string& paragraph : introduction.paragraphs) {
    page.text +=
        (&paragraph == &introduction.paragraphs.front() ? "" : ".PP\n") + escaped(paragraph) + "\n";
  }
  if (!program.commands.empty()) {
    page.text += commands(program);
  }
  page.text += list_of(program.self.arguments, "ARGUMENTS") +
               list_of(program.self.options, "OPTIONS") + built_in() + exit_status() +
               see_also(introduction.see_also);
  return page;
}

std::vector<ManPage> man_pages(const Program& program, const Introduction& introduction) {
  std::vector<ManPage> pages{page_of_program(program, introduction)};
  for (const Command& command : program.commands) {
    pages.push_back(page_of_command(program, command, introduction));
  }
  return pages;
}

}  // namespace transillum::manual
