// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "transillum/errors.h"
#include "transillum/vec3.h"

namespace transillum::viewer {

/// Reads an object of a JSON file key by key. Errors throw an InputError that begins with the
/// place: "room.json, page 3, camera: …".
class JsonObject {
 public:
  /// @param where  beginning of every message
  /// @throws InputError if `value` is not an object
  JsonObject(const nlohmann::json& value, std::string where)
      : value_(value), where_(std::move(where)) {
    if (!value_.is_object()) {
      fail("must be an object { … }");
    }
  }

  /// The value of a key; null if it is missing, or null in the file.
  const nlohmann::json* find(const std::string& key) {
    known_.insert(key);
    const auto found = value_.find(key);
    return found == value_.end() || found->is_null() ? nullptr : &*found;
  }

  /// Sets `value` to the value of a key; leaves it unchanged if there is none.
  /// @throws InputError if it has another type
  void read(const std::string& key, std::string& value);
  void read(const std::string& key, bool& value);
  void read(const std::string& key, double& value);
  /// @param least,most  valid range
  void read(const std::string& key, int& value, int least, int most);
  void read(const std::string& key, Vec3& value);

  /// Throws an error about a key.
  [[noreturn]] void fail_at(const std::string& key, const std::string& what) const {
    throw InputError(where_ + ", " + key + ": " + what);
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(where_ + ": " + what); }
  std::string where(const std::string& key) const { return where_ + ", " + key; }

  /// To be called after all keys are read. @throws InputError naming a key that was not read
  void done() const;

 private:
  const nlohmann::json& value_;
  std::string where_;
  std::set<std::string> known_;
};

/// A string of a file in quotes, for a message: one line of at most 40 characters.
std::string in_quotes(const std::string& text);

/// Reads [x, y, z]. @throws InputError that begins with `where`
Vec3 vec3_from_json(const nlohmann::json& value, const std::string& where);
nlohmann::json to_json(const Vec3& v);

/// Parses the text of a file after check_json(). @throws InputError as check_json() does
nlohmann::json parse_json(const std::string& text, const std::string& name);

}  // namespace transillum::viewer
