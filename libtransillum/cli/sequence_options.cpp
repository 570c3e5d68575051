// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "sequence_options.h"

#include <fmt/format.h>

#include "option_values.h"

namespace transillum::cli {

void add_sequence_options(CLI::App& command, SequenceOptions& options) {
  add_parsed_option(command, "-m,--directions", "M", help_of("directions", options.directions),
                    [&options](const std::string& text) {
                      options.directions =
                          static_cast<int>(parse_whole_number("--directions", text, 1, 1 << 24));
                    });
  add_parsed_option(
      command, "--sampling", "NAME",
      choice_help("sampling", sampling_names(), name_of(default_sampling(true))),
      [&options](const std::string& text) { options.sampling = sampling_from_name(text); });
  add_parsed_option(
      command, "--seed", "S", help_of("seed", options.seed),
      [&options](const std::string& text) { options.seed = parse_seed("--seed", text); });
  add_parsed_option(
      command, "--rotate", "S", help_of("rotate", "none"),
      [&options](const std::string& text) { options.rotation = parse_seed("--rotate", text); });
}

void check_seed(const CLI::App& command, const SequenceOptions& options) {
  refuse_unless(is_seeded(options.used_sampling()), command, "--seed",
                "used only with sampling random, sobol or scrambled-hammersley");
}

}  // namespace transillum::cli
