// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: the readers of checkpoints and shards. The first byte of an input chooses how the
// others are read: as a whole file, as the state of a solver, or as the passes of a shard, which
// gets a valid head and CRC here: no mutation would find these.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "io/runs/shard_files.h"
#include "transillum/checkpoint.h"
#include "transillum/errors.h"

namespace transillum::fuzz {
namespace {

/// A file in memory.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("fuzz", 0)) {}
  std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }
  void set(std::string_view content) const {
    require(::ftruncate(file_, 0) == 0 && ::pwrite(file_, content.data(), content.size(), 0) >= 0,
            "the file can be written");
  }

 private:
  int file_;
};

const std::shared_ptr<const Scene>& scene() {
  static const std::shared_ptr<const Scene> scene = load_scene("furnace");
  return scene;
}

const std::shared_ptr<const BspTree>& tree() {
  static const auto tree = std::make_shared<const BspTree>(*scene());
  return tree;
}

SolveOptions options_of(unsigned variant) {
  SolveOptions options{.directions = 6, .iterations = 3, .threads = 1};
  options.replicas = variant % 2 == 0 ? 1 : 2;
  if (variant / 2 % 2 == 1) {
    options.scheme = Scheme::semi_iterative;
  }
  if (variant / 4 % 2 == 1) {
    options.sky.exitance = {1, 1, 1};
  }
  return options;
}

/// A state that is accepted is one from which a solve continues, to an end or to an error of a
/// solve.
void check_state(std::string_view bytes, const SolveOptions& options) {
  RadiositySolver solver(scene(), options, {.tree = tree()});
  try {
    std::istringstream in{std::string(bytes)};
    solver.restore(in, bytes.size());
    for (int step = 0; step < 3; ++step) {
      solver.advance(RadiositySolver::Until::iteration);
    }
    solver.solution();
  } catch (const std::runtime_error&) {
  }
}

/// Calls `read`, whose only exception may be an InputError with one short line.
template <class Read>
void check_reader(const MemoryFile& file, const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    constexpr std::size_t longest_message = 400;
    require(text.starts_with(file.path()) || text.starts_with("shards are missing"),
            "an error begins with the file");
    require(text.find('\n') == std::string_view::npos, "an error is one line");
    require(text.size() <= longest_message, "an error is short");
  }
}

void check_file(std::string_view bytes) {
  static const MemoryFile file;
  file.set(bytes);
  const SolveOptions options = options_of(0);
  check_reader(file, [&] {
    SolveSession session({.scene = scene(), .options = options, .tree = tree()});
    Checkpoint(file.path(), *scene(), options).resume(session);
  });
  check_reader(file, [&] { engine_of_shards({file.path()}, *scene(), options); });
}

/// Kind and head of a shard of the scene.
std::string shard_head() {
  static const std::string head = [] {
    const std::string path = fmt::format("/tmp/transillum-fuzz-{}.tsh", ::getpid());
    write_shard(path, scene(), options_of(0), tree(), {{1, 1}, {}, {}});
    std::string content;
    FILE* const in = std::fopen(path.c_str(), "rb");
    for (int c = std::fgetc(in); c != EOF; c = std::fgetc(in)) {
      content += static_cast<char>(c);
    }
    std::fclose(in);
    ::unlink(path.c_str());
    const std::size_t line = content.find('\n');
    return content.substr(0, content.find('\n', line + 1) + 1);
  }();
  return head;
}

void check_passes(std::string_view bytes) {
  static const MemoryFile file;
  std::string content = shard_head() + std::string(bytes);
  const auto crc =
      ::crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  file.set(content + fmt::format("{:08x}", crc));
  check_reader(file, [&] {
    const SolveOptions options = options_of(0);
    RadiositySolver solver(
        scene(), options,
        {.tree = tree(), .engine = engine_of_shards({file.path()}, *scene(), options)});
    try {
      solver.advance(RadiositySolver::Until::finished);
    } catch (const InputError&) {  // a direction that no pass has
    } catch (const std::runtime_error&) {
    }
  });
}

}  // namespace
}  // namespace transillum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      transillum::fuzz::check_file(bytes);
      break;
    case 1:
      transillum::fuzz::check_passes(bytes);
      break;
    default:
      transillum::fuzz::check_state(bytes, transillum::fuzz::options_of(data[0] / 4));
  }
  return 0;
}
