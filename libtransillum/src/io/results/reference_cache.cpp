// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Cache of reference solutions for studies. A file's name is the hash of the scene and of all
// options that change B; it holds a line with format version and hash, the doubles of B in memory
// order, and a hash of both.
#include "io/results/reference_cache.h"

#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "io/content_hash.h"
#include "options/option_table.h"
#include "transillum/files.h"
#include "transillum/study.h"

namespace transillum {
namespace {

namespace fs = std::filesystem;

/// Adds the options that change B: not the memory nor the number of threads.
void add_options(ContentHash& hash, const SolveOptions& solve) {
  for (const Option& option : options()) {
    if (!option.of_machine) {
      hash.add(option.name);
      hash.add(option.print({.solve = solve}));
    }
  }
  // No options of a command line.
  hash.add(solve.engine_options.lines_per_patch);
  hash.add(static_cast<int>(solve.engine_options.gridded));
  hash.add(solve.averaged_iterations);
}

std::string key_of(const Scene& scene, const SolveOptions& options) {
  ContentHash hash;
  hash.add(std::string(TRANSILLUM_VERSION));
  hash.add(static_cast<int>(std::endian::native == std::endian::little));
  hash.add_shape(scene);
  hash.add_light(scene);
  add_options(hash, options);
  return hash.digits();
}

std::string file_name(const std::string& key) { return key + ".reference"; }

std::string first_line(const std::string& key) {
  return fmt::format("transillum reference 1 {}\n", key);
}

std::string digits_of(const std::string& key, const std::vector<Rgb>& radiosity) {
  ContentHash hash;
  hash.add(key);
  for (const Rgb& b : radiosity) {
    hash.add(b);
  }
  return hash.digits();
}

static_assert(sizeof(Rgb) == 3 * sizeof(double), "values are written in memory order");

/// Reads `values` values from a reference; nothing where it is missing or damaged.
std::optional<std::vector<Rgb>> read_reference(const fs::path& file, const std::string& key,
                                               std::size_t values) {
  const std::string head = first_line(key);
  std::vector<Rgb> radiosity(values);
  const std::size_t size = radiosity.size() * sizeof(Rgb);
  std::string found_head(head.size(), '\0'), digits(key.size(), '\0');
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return std::nullopt;  // opening a pipe would block
  }
  if (fs::file_size(file, error) != head.size() + size + digits.size()) {
    return std::nullopt;
  }
  std::ifstream in(file, std::ios::binary);
  in.read(found_head.data(), static_cast<std::streamsize>(found_head.size()));
  in.read(reinterpret_cast<char*>(radiosity.data()), static_cast<std::streamsize>(size));
  in.read(digits.data(), static_cast<std::streamsize>(digits.size()));
  if (!in || found_head != head || digits != digits_of(key, radiosity)) {
    return std::nullopt;
  }
  return radiosity;
}

}  // namespace

fs::path ReferenceCache::default_folder() {
  // XDG Base Directory Specification: paths that are not absolute must be ignored.
  for (const auto& [variable, below] : {std::pair{"XDG_CACHE_HOME", ""}, {"HOME", ".cache"}}) {
    const char* value = std::getenv(variable);
    if (value != nullptr && fs::path(value).is_absolute()) {
      return fs::path(value) / below / "transillum";
    }
  }
  return {};
}

fs::path ReferenceCache::file_of(const Scene& scene, const SolveOptions& options) const {
  return folder_.empty() ? fs::path() : folder_ / file_name(key_of(scene, options));
}

std::optional<std::vector<Rgb>> ReferenceCache::find(const Scene& scene,
                                                     const SolveOptions& options) const {
  if (folder_.empty()) {
    return std::nullopt;
  }
  const std::size_t per_patch = options.basis == Basis::linear ? 3 : 1;
  const std::size_t values = per_patch * static_cast<std::size_t>(scene.patch_count());
  const std::string key = key_of(scene, options);
  return read_reference(folder_ / file_name(key), key, values);
}

void ReferenceCache::store(const Scene& scene, const SolveOptions& options,
                           const std::vector<Rgb>& radiosity) const {
  if (folder_.empty()) {
    return;
  }
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("{}: cannot be created: {}", folder_.string(), error.message()));
  }
  const std::string key = key_of(scene, options);
  write_file_whole(folder_ / file_name(key), [&](std::ostream& out) {
    out << first_line(key);
    out.write(reinterpret_cast<const char*>(radiosity.data()),
              static_cast<std::streamsize>(radiosity.size() * sizeof(Rgb)));
    out << digits_of(key, radiosity);
  });
}

ReferenceSolution find_or_solve_reference(const ReferenceCache& cache,
                                          const std::shared_ptr<const Scene>& scene,
                                          const std::shared_ptr<const BspTree>& tree,
                                          const SolveOptions& options,
                                          const std::function<void(const SolveProgress&)>& observer,
                                          const Cancellation& cancellation) {
  ReferenceSolution solution;
  if (auto found = cache.find(*scene, options)) {
    solution.radiosity = *std::move(found);
    solution.from_cache = true;
    return solution;
  }
  solution.radiosity = solve_reference(scene, tree, options, observer, cancellation);
  try {
    cache.store(*scene, options, solution.radiosity);
  } catch (const std::exception& error) {
    solution.store_error = error.what();
  }
  return solution;
}

}  // namespace transillum
