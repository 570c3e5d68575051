// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// The text of JSON files that programs read: bounded and checked before a parser builds anything.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>


namespace transillum {

/// Largest JSON file accepted, bytes.
inline constexpr std::uintmax_t largest_json_file = std::uintmax_t{16} << 20;
/// Most levels of lists and objects inside each other.
inline constexpr std::size_t deepest_json = 64;
/// Most values (lists, objects, strings, numbers, true, false, null) in one text of at most
/// largest_json_file bytes; formats that may be larger may have any number.
inline constexpr std::size_t most_json_values = 1'000'000;

/// Reads a JSON file; check_json() is still to be called.
/// @throws InputError if it is missing, not a regular file, unreadable, binary or too large
std::string read_json_file(const std::filesystem::path& path);

/// Checks a text, in time linear in its length and with a stack of constant size. Once it passes,
/// any JSON parser reads it in bounded memory, and no recursion over its values is deep.
/// It must be one JSON value (RFC 8259) in UTF-8, with or without a byte order mark, within the
/// limits above, without a number beyond the range of double and without a key twice in one object.
/// @param name  of the file, at the beginning of messages
/// @param limit  most bytes; more than largest_json_file for scenes, whose values are not counted
/// @throws InputError naming line, column (from 1, in characters) and problem
void check_json(std::string_view text, const std::string& name,
                std::uintmax_t limit = largest_json_file);

}  // namespace transillum
