// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first look at a glTF file: extensions, and the places of data. tinygltf loads the buffers
// before one can ask which extensions a file requires, and takes an offset that it cannot read as
// 0; so both are read here, by the events of a parser. Where data are compressed, what they replace
// may be missing: buffers have a length only, indices no data.
#include "scene/read/gltf/gltf_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "transillum/errors.h"

namespace transillum {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 4> places{"bufferView", "buffer", "byteOffset",
                                                 "byteStride"};

/// Receives the events of the parser, which builds nothing: with nlohmann's callback, each entry of
/// a list would be searched for what was discarded.
class Outline : public nlohmann::json_sax<json> {
 public:
  explicit Outline(const std::string& name) : name_(name) {}
  std::vector<std::string> required;

  bool null() override { return value("null", false); }
  bool boolean(bool v) override { return value(v ? "true" : "false", false); }
  bool number_integer(number_integer_t v) override { return value(std::to_string(v), v >= 0); }
  bool number_unsigned(number_unsigned_t) override { return value({}, true); }
  bool number_float(number_float_t v, const string_t&) override {
    return value(fmt::format("{}", v), false);
  }
  bool string(string_t& v) override {
    if (depth_ == 2 && list_ == "extensionsRequired") {
      required.push_back(v);
    }
    return value(fmt::format("\"{}\"", v.substr(0, 40)), false);
  }
  bool binary(binary_t&) override { return true; }
  bool key(string_t& v) override {
    if (depth_ == 1) {
      list_ = v;
      entry_ = 0;
    }
    key_ = depth_ == 3 ? v : string_t();
    return true;
  }
  bool start_object(std::size_t) override { return start(); }
  bool start_array(std::size_t) override { return start(); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;  // check_json() has found none
  }

 private:
  bool start() {
    value("a list or an object", false);
    ++depth_;
    key_.clear();
    return true;
  }
  bool end() {
    --depth_;
    entry_ += depth_ == 2 ? 1 : 0;
    key_.clear();
    return true;
  }
  /// A value at the last key.
  bool value(const std::string& text, bool is_place) const {
    if (depth_ == 3 && !is_place && (list_ == "bufferViews" || list_ == "accessors") &&
        std::find(places.begin(), places.end(), key_) != places.end()) {
      throw InputError(fmt::format("{}: {} {}: {} {} is not a whole number of at least 0", name_,
                                   list_, entry_, key_, text));
    }
    return true;
  }

  const std::string& name_;
  int depth_ = 0;
  std::string list_, key_;  ///< the list of the file, and the key of its entry
  std::size_t entry_ = 0;
};

bool has_extension(const json& object, const char* name) {
  return object.is_object() && object.contains("extensions") && object["extensions"].is_object() &&
         object["extensions"].contains(name);
}

}  // namespace

std::vector<std::string> required_extensions(std::string_view text, const std::string& name) {
  Outline outline(name);
  json::sax_parse(text.begin(), text.end(), &outline);
  return outline.required;
}

bool is_compressed_gltf(std::string_view text) {
  return text.find(meshopt_extension) != std::string_view::npos ||
         text.find(draco_extension) != std::string_view::npos;
}

std::string parsable_gltf(std::string_view text) {
  json all = json::parse(text);
  for (json& buffer : all["buffers"]) {
    if (has_extension(buffer, meshopt_extension) && !buffer.contains("uri")) {
      buffer["uri"] = "data:application/octet-stream;base64,AA==";
      buffer["byteLength"] = 1;
    }
  }
  for (json& mesh : all["meshes"]) {
    for (json& primitive : mesh["primitives"]) {
      if (has_extension(primitive, draco_extension)) {
        primitive.erase("indices");
      }
    }
  }
  return all.dump();
}

}  // namespace transillum
