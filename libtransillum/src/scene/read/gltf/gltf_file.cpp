// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// tinygltf parses the JSON and loads buffers; files are read by callbacks of ours, which accept
// regular files of bounded size only, and images are kept encoded. The text is checked before
// (decisions/0043-json-is-checked-before-it-is-parsed.md).
#include "scene/read/gltf/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/json_text.h"
#include "base/text_file.h"
#include "scene/read/gltf/gltf_expansion.h"
#include "scene/read/gltf/gltf_outline.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::string_view glb_magic = "glTF";
constexpr std::size_t glb_header = 12, glb_chunk_header = 8;

std::uint32_t word_at(std::string_view bytes, std::size_t position) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    word |= std::uint32_t{static_cast<unsigned char>(bytes[position + k])} << (8 * k);
  }
  return word;
}

/// One line of a message of the parser, which may have several, without data in strings.
std::string one_line(const std::string& text) {
  std::string line;
  const std::size_t data = text.find("data:");
  const std::size_t comma = std::min(text.find(',', std::min(data, text.size())), text.size());
  const std::size_t end = std::min(text.find_first_of(" \n", comma), text.size());
  const std::string shown =
      data < text.size() ? text.substr(0, comma) + ",…" + text.substr(end) : text;
  for (const char c : shown.substr(0, 300)) {
    const bool blank = static_cast<unsigned char>(c) <= ' ';
    if (!blank || (!line.empty() && line.back() != ' ')) {
      line += blank ? ' ' : c;
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) {
    line.pop_back();
  }
  return line;
}

/// A .glb file with another text. The first chunk is the text.
std::string with_text(std::string_view bytes, std::string text) {
  const std::size_t rest = glb_header + glb_chunk_header + word_at(bytes, glb_header);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string file(bytes.substr(0, glb_header + glb_chunk_header));
  const auto put = [&](std::size_t position, std::size_t word) {
    for (std::size_t k = 0; k < 4; ++k) {
      file[position + k] = static_cast<char>(word >> (8 * k));
    }
  };
  put(8, file.size() + text.size() + bytes.size() - rest);
  put(glb_header, text.size());
  return file.append(text).append(bytes.substr(rest));
}

/// Newer versions of tinygltf ask for the size before they read.
template <class Callbacks>
void leave_sizes_to_reading(Callbacks& callbacks) {
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
      *size = 0;
      return true;
    };
  }
}

/// The callbacks that tinygltf reads files by. `files` collects their names.
tinygltf::FsCallbacks file_callbacks(std::vector<std::string>& files) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string& path, void*) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
  };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string* error,
                               const std::string& path, void* user) {
    try {
      const std::string read = read_binary_file(path, largest_scene_file);
      bytes->assign(read.begin(), read.end());
      static_cast<std::vector<std::string>*>(user)->push_back(path);
      return true;
    } catch (const InputError& problem) {
      *error += problem.what();
      return false;
    }
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                void*) { return false; };
  leave_sizes_to_reading(callbacks);
  callbacks.user_data = &files;
  return callbacks;
}

/// Keeps an image's bytes as they are in its file. Those in buffers are found later: the parser
/// does not check that they are inside.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && size > 0) {
    image->image.assign(bytes, bytes + size);
  }
  image->as_is = true;
  return true;
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& path, const Cancellation& cancellation)
    : name_(path.string()), cancellation_(cancellation), files_{path.string()} {
  try {
    load(read_binary_file(path, largest_scene_file));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    // The parser's JSON library throws where a value is of another type than the format says.
    fail("is not a valid glTF file: " + one_line(error.what()));
  }
}

void GltfFile::fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

std::string_view GltfFile::text_of(std::string_view bytes) const {
  if (!bytes.starts_with(glb_magic)) {
    return bytes;
  }
  if (bytes.size() < glb_header + glb_chunk_header) {
    fail("is cut: the header of a .glb file has 20 bytes");
  }
  if (word_at(bytes, 4) != 2) {
    fail(fmt::format("is of version {} of glTF; version 2 can be read", word_at(bytes, 4)));
  }
  const std::size_t size = word_at(bytes, glb_header);
  if (size > bytes.size() - glb_header - glb_chunk_header || word_at(bytes, 8) > bytes.size()) {
    fail(fmt::format("is cut: its header states {} bytes, it has {}", word_at(bytes, 8),
                     bytes.size()));
  }
  return bytes.substr(glb_header + glb_chunk_header, size);
}

void GltfFile::load(std::string bytes) {
  const std::string_view text = text_of(bytes);
  check_json(text, name_, largest_scene_file);
  cancellation_.throw_if_canceled();
  check_extensions(required_extensions(text, name_));
  if (is_compressed_gltf(text)) {
    std::string parsable = parsable_gltf(text);
    bytes =
        bytes.starts_with(glb_magic) ? with_text(bytes, std::move(parsable)) : std::move(parsable);
  }
  cancellation_.throw_if_canceled();
  parse(bytes);
  try {
    quantized_ = expand_gltf(model_, cancellation_);
  } catch (const InputError& error) {
    fail(error.what());
  }
  cancellation_.throw_if_canceled();
}

void GltfFile::check_extensions(const std::vector<std::string>& required) const {
  std::vector<std::string> unknown;
  for (const std::string& extension : required) {
    // Extensions that change where surfaces are, or how they are stored. Materials have a fallback.
    const bool of_materials = extension.starts_with("KHR_materials_") ||
                              extension.starts_with("KHR_texture_") ||
                              extension == "EXT_texture_webp" || extension == "KHR_lights_punctual";
    const bool of_meshes = extension == "KHR_mesh_quantization" || extension == draco_extension ||
                           extension == meshopt_extension;
    if (!of_materials && !of_meshes) {
      unknown.push_back(extension);
    }
  }
  if (!unknown.empty()) {
    fail(fmt::format("requires {}, which cannot be read; export it without these extensions",
                     fmt::join(unknown, ", ")));
  }
}

void GltfFile::parse(const std::string& bytes) {
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keep_image, nullptr);
  parser.SetFsCallbacks(file_callbacks(files_));
  std::string error, warning;
  const std::string folder = std::filesystem::path(name_).parent_path().string();
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool loaded =
      std::string_view(bytes).starts_with(glb_magic)
          ? parser.LoadBinaryFromMemory(&model_, &error, &warning,
                                        reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                        folder)
          : parser.LoadASCIIFromString(&model_, &error, &warning, bytes.data(), size, folder);
  if (!loaded) {
    fail("is not a valid glTF file: " + one_line(error));
  }
  if (!model_.asset.version.starts_with("2.")) {
    fail(fmt::format("is of version {} of glTF; version 2 can be read",
                     in_quotes(model_.asset.version)));
  }
}

const tinygltf::Accessor& GltfFile::accessor(int index) const {
  if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) {
    fail(fmt::format("accessor {} does not exist; there are {}", index, model_.accessors.size()));
  }
  return at(model_.accessors, index);
}

std::size_t GltfFile::count_of(int index, std::size_t largest_count) const {
  const std::size_t count = accessor(index).count;
  if (count > largest_count) {
    fail(fmt::format("accessor {} has {} entries; at most {} are left", index, count,
                     largest_count));
  }
  return count;
}

std::span<const unsigned char> GltfFile::bytes_of(int index, std::size_t offset,
                                                  std::size_t size) const {
  if (index < 0 || static_cast<std::size_t>(index) >= model_.bufferViews.size()) {
    fail(fmt::format("buffer view {} does not exist; there are {}", index,
                     model_.bufferViews.size()));
  }
  const tinygltf::BufferView& view = at(model_.bufferViews, index);
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size()) {
    fail(fmt::format("buffer {} does not exist; there are {}", view.buffer, model_.buffers.size()));
  }
  const std::vector<unsigned char>& data = at(model_.buffers, view.buffer).data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset ||
      offset > view.byteLength || size > view.byteLength - offset) {
    fail(fmt::format("buffer view {} has no {} bytes from byte {}: buffer {} has {} bytes", index,
                     size, offset, view.buffer, data.size()));
  }
  return std::span(data).subspan(view.byteOffset + offset, view.byteLength - offset);
}

std::span<const unsigned char> GltfFile::image_bytes(std::size_t index) const {
  const tinygltf::Image& image = model_.images[index];
  return image.bufferView >= 0 ? bytes_of(image.bufferView, 0, 0)
                               : std::span<const unsigned char>(image.image);
}

namespace {

template <class Number>
Number number_at(const unsigned char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return number;
}

/// A number of the type that an accessor states.
double number_of_type(int type, const unsigned char* bytes, bool normalized) {
  const auto scaled = [normalized](auto number) {
    using Number = decltype(number);
    const auto value = static_cast<double>(number);
    return normalized
               ? std::max(value / static_cast<double>(std::numeric_limits<Number>::max()), -1.0)
               : value;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(number_at<std::int8_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(number_at<std::uint8_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(number_at<std::int16_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(number_at<std::uint16_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return scaled(number_at<std::uint32_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return static_cast<double>(number_at<float>(bytes));
    default:
      return number_at<double>(bytes);
  }
}

std::size_t size_of_type(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return 8;
    default:
      return 0;
  }
}

bool is_whole_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace

std::vector<double> GltfFile::numbers(int index, std::size_t components) const {
  const tinygltf::Accessor& from = accessor(index);
  const std::int32_t stated =
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(from.type));
  const std::size_t size = size_of_type(from.componentType);
  if (size == 0 || stated < static_cast<std::int32_t>(components)) {
    fail(fmt::format("accessor {} must have {} numbers per entry", index, components));
  }
  const std::size_t entry = size * static_cast<std::size_t>(stated);
  std::vector<double> values(from.count * components, 0.0);
  const auto read = [&](std::span<const unsigned char> bytes, std::size_t stride, std::size_t count,
                        auto target) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t to = target(k);
      for (std::size_t c = 0; c < components; ++c) {
        values[to * components + c] = number_of_type(
            from.componentType, bytes.data() + k * stride + c * size, from.normalized);
      }
    }
  };
  if (from.bufferView >= 0 && from.count > 0) {
    bytes_of(from.bufferView, 0, 0);  // the view exists
    const std::size_t stated_stride = at(model_.bufferViews, from.bufferView).byteStride;
    const std::size_t stride = stated_stride == 0 ? entry : stated_stride;
    if (stride > 65536 || from.count > largest_scene_file) {
      fail(fmt::format("accessor {}: {} entries {} bytes apart", index, from.count, stride));
    }
    read(bytes_of(from.bufferView, from.byteOffset, (from.count - 1) * stride + entry), stride,
         from.count, [](std::size_t k) { return k; });
  }
  if (from.sparse.isSparse && from.sparse.count > 0) {
    const auto count = static_cast<std::size_t>(from.sparse.count);
    const std::size_t index_size = size_of_type(from.sparse.indices.componentType);
    if (!is_whole_type(from.sparse.indices.componentType) || count > from.count ||
        std::cmp_less(from.sparse.indices.byteOffset, 0) ||
        std::cmp_less(from.sparse.values.byteOffset, 0)) {
      fail(fmt::format("accessor {} has invalid sparse values", index));
    }
    const auto where =
        bytes_of(from.sparse.indices.bufferView,
                 static_cast<std::size_t>(from.sparse.indices.byteOffset), count * index_size);
    const auto what =
        bytes_of(from.sparse.values.bufferView,
                 static_cast<std::size_t>(from.sparse.values.byteOffset), count * entry);
    read(what, entry, count, [&](std::size_t k) {
      const auto to = static_cast<std::size_t>(
          number_of_type(from.sparse.indices.componentType, where.data() + k * index_size, false));
      if (to >= from.count) {
        fail(fmt::format("accessor {} has a sparse value for entry {} of {}", index, to,
                         from.count));
      }
      return to;
    });
  }
  return values;
}

std::vector<std::uint32_t> GltfFile::indices(int index) const {
  if (!is_whole_type(accessor(index).componentType)) {
    fail(fmt::format("accessor {} must have whole numbers", index));
  }
  const std::vector<double> values = numbers(index, 1);
  std::vector<std::uint32_t> whole(values.size());
  std::transform(values.begin(), values.end(), whole.begin(),
                 [](double v) { return static_cast<std::uint32_t>(v); });
  return whole;
}

double GltfFile::rounding_of(int index, double largest) const {
  if (const auto found = quantized_.find(index); found != quantized_.end()) {
    return found->second + 0x1p-24 * largest;
  }
  const tinygltf::Accessor& of = accessor(index);
  switch (of.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 0x1p-24 * largest;
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return 0x1p-53 * largest;
    default: {
      const auto bits = static_cast<int>(8 * size_of_type(of.componentType));
      return of.normalized ? std::ldexp(0.5, 1 - bits) : 0.5;
    }
  }
}

}  // namespace transillum
