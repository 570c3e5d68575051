// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: the readers of all formats of scenes but OBJ, joining, and the construction of
// patches. The first byte of an input, of which four bits count ('1' and 1 are the same), chooses
// the format; the rest is the file.
#include <cstdint>
#include <string_view>

#include "fuzz/require.h"
#include "fuzz/scene_checks.h"
#include "support/temporary_folder.h"
#include "transillum/errors.h"

namespace transillum::fuzz {
namespace {

void check_file(const std::string& path) {
  // More faces than an input of a fuzzer has only come from instances, and take long.
  constexpr std::size_t most_faces = 20'000;
  const SceneDescription separate = describe_scene(path, {.join = false});
  if (separate.face_count() > most_faces) {
    return;
  }
  const Scene scene(separate);
  check(scene);
  const SceneDescription joined = describe_scene(path, {.join = true});
  require(joined.face_count() <= separate.face_count(), "joining makes no faces");
  check(Scene(joined));
}

}  // namespace
}  // namespace transillum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace transillum;
  static const test::TemporaryFolder folder;
  if (size == 0) {
    return 0;
  }
  const std::vector<SceneFormat>& formats = scene_formats();
  const std::string& ending = formats[(data[0] & 15) % formats.size()].ending;
  const std::string_view input(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string path = folder.write("scene" + ending, input);
  try {
    fuzz::check_file(path);
  } catch (const InputError& error) {
    fuzz::require(std::string_view(error.what()).find('\n') == std::string_view::npos,
                  "an error is one line");
  }
  return 0;
}
