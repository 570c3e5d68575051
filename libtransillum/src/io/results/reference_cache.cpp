// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Cache of reference solutions for studies. A file's name is the hash of the scene and of all
// options that change B; it holds a line with format version and hash, the doubles of B in memory
// order, and a hash of both.
#include "transillum/reference_cache.h"

#include <fmt/format.h>
#include <vtksys/MD5.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

#include "transillum/files.h"
#include "transillum/study.h"

namespace transillum {
namespace {

namespace fs = std::filesystem;

/// MD5: detects accidental changes, not deliberate ones.
class Hash {
 public:
  Hash() : md5_(vtksysMD5_New(), vtksysMD5_Delete) { vtksysMD5_Initialize(md5_.get()); }

  template <typename Value>
  void add(const Value& value) {
    static_assert(std::has_unique_object_representations_v<Value> ||
                  std::is_floating_point_v<Value>);
    append(&value, sizeof value);
  }
  void add(const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) {
      add(x);
    }
  }
  void add(const Rgb& v) {
    for (const double x : {v.r, v.g, v.b}) {
      add(x);
    }
  }
  void add(const std::string& text) {
    add(text.size());
    append(text.data(), text.size());
  }
  /// The hash as 32 hexadecimal digits; may be called once.
  std::string digits() {
    std::array<char, 32> text{};
    vtksysMD5_FinalizeHex(md5_.get(), text.data());
    return {text.data(), text.size()};
  }

 private:
  void append(const void* data, std::size_t size) {
    // MD5.h counts in int, and a negative length means "up to the final zero".
    constexpr std::size_t max_block = 1U << 30;
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t done = 0; done < size; done += max_block) {
      vtksysMD5_Append(md5_.get(), bytes + done,
                       static_cast<int>(std::min(max_block, size - done)));
    }
  }

  std::unique_ptr<vtksysMD5, void (*)(vtksysMD5*)> md5_;
};

void add_scene(Hash& hash, const Scene& scene) {
  hash.add(scene.points().size());
  for (const Vec3& point : scene.points()) {
    hash.add(point);
  }
  hash.add(scene.patch_count());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    hash.add(scene.outline(i).size());
    for (const PointId corner : scene.outline(i)) {
      hash.add(corner);
    }
    hash.add(scene.exitance(i));
    hash.add(scene.reflectance(i));
  }
}

/// Adds the options that change B: not the memory nor the number of threads.
void add_options(Hash& hash, const SolveOptions& options) {
  hash.add(options.directions);
  hash.add(name_of(options.used_sampling()));
  hash.add(options.seed);
  hash.add(options.rotation ? std::to_string(*options.rotation) : std::string("none"));
  hash.add(name_of(options.engine));
  hash.add(options.engine_options.lines_per_patch);
  hash.add(static_cast<int>(options.engine_options.gridded));
  hash.add(options.engine_options.seed);
  hash.add(options.engine_options.resolution);
  hash.add(name_of(options.engine_options.order));
  hash.add(static_cast<int>(options.two_way));
  hash.add(name_of(options.normalize));
  hash.add(name_of(options.scheme));
  hash.add(options.burn_in.value_or(-1));
  hash.add(options.averaged_iterations);
  hash.add(options.replicas);
  hash.add(options.iterations);
  constexpr double no_shot = -2;  // no value that the option can have
  hash.add(options.first_shot.value_or(no_shot));
  hash.add(options.tolerance);
  if (options.sky.set()) {
    hash.add(options.sky.exitance);
    hash.add(name_of(options.sky.model));
    hash.add(options.sky.up);
  }
}

std::string key_of(const Scene& scene, const SolveOptions& options) {
  Hash hash;
  hash.add(std::string(TRANSILLUM_VERSION));
  hash.add(static_cast<int>(std::endian::native == std::endian::little));
  add_scene(hash, scene);
  add_options(hash, options);
  return hash.digits();
}

std::string first_line(const std::string& key) {
  return fmt::format("transillum reference 1 {}\n", key);
}

std::string digits_of(const std::string& key, const std::vector<Rgb>& radiosity) {
  Hash hash;
  hash.add(key);
  for (const Rgb& b : radiosity) {
    hash.add(b);
  }
  return hash.digits();
}

static_assert(sizeof(Rgb) == 3 * sizeof(double), "values are written in memory order");

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
  return folder_.empty() ? fs::path() : folder_ / (key_of(scene, options) + ".reference");
}

std::optional<std::vector<Rgb>> ReferenceCache::find(const Scene& scene,
                                                     const SolveOptions& options) const {
  if (folder_.empty()) {
    return std::nullopt;
  }
  const std::string key = key_of(scene, options);
  const std::string head = first_line(key);
  std::vector<Rgb> radiosity(static_cast<std::size_t>(scene.patch_count()));
  const std::size_t size = radiosity.size() * sizeof(Rgb);
  std::string found_head(head.size(), '\0'), digits(32, '\0');

  const fs::path file = folder_ / (key + ".reference");
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
  write_file_whole(folder_ / (key + ".reference"), [&](std::ostream& out) {
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
