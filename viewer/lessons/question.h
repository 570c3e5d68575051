// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lessons/lesson_value.h"
#include "lessons/view_state.h"
#include "transillum/visibility_map.h"

namespace transillum::viewer {

class ComputedValues;
class JsonObject;

/// A question on a page of a lesson. What is right is computed from values of the page's scene and
/// run, never stated by the file.
struct Question {
  enum class Kind {
    choice,   ///< choose one of `choices`
    patch,    ///< select a patch
    number,   ///< enter a number
    area,     ///< draw a polygon on the visibility map
    outline,  ///< draw a polygon on a patch in the scene
    curve     ///< draw a curve in a chart; its points are `choices`
  };
  enum class Rule {
    largest,   ///< the choice, or patch, with the largest value
    smallest,  ///< the choice, or patch, with the smallest value
    nearest,   ///< the choice whose value is nearest to `wanted`
    equals,    ///< choices whose value is `wanted`
    value      ///< `wanted` itself
  };
  struct Choice {
    std::string text;                  ///< the value is shown if it is empty
    std::optional<LessonValue> value;  ///< if it is not set, the choice is right where no other is
    std::string reason;                ///< why it is wrong: what its value belongs to; may be empty
  };

  Kind kind = Kind::choice;
  std::string ask;              ///< Markdown
  std::vector<Choice> choices;  ///< usual mistakes, where a number is asked for
  Rule rule = Rule::value;
  LessonValue wanted;
  /// How close an answer has to be: for a number, the largest relative difference; for an area, the
  /// least overlap (the common part over the union); for a curve, the largest mean distance.
  double within = 0;
  bool percent = false;             ///< values are shown, and entered, times 100, with " %"
  std::string unit;                 ///< unit of the values
  std::string then;                 ///< Markdown, shown after Reveal; may be empty
  std::optional<ViewState> reveal;  ///< state that Reveal shows; if not set, the page stays as it
                                    ///< is
};

/// Refuses texts of more than 64 KiB (Qt takes 40 s for 1.6 MB of Markdown), and marks [[ and ]]
/// that are not in pairs.
/// @param key of `object` that the text is at
/// @throws InputError
void check_markdown(const std::string& text, const JsonObject& object, const char* key);
/// A text of a lesson for the window: without the marks [[ and ]] around what speaks of the window.
QString window_text(const std::string& text);
/// A text of a lesson for a web page: without what is between these marks.
QString web_text(const std::string& text);

/// An answer by a user; what does not belong to the question's kind is ignored.
struct GivenAnswer {
  int choice = -1;
  PatchId patch = no_patch;
  std::optional<double> number = {};
  std::vector<Vec2> outline = {};    ///< corners of a polygon on the plane, m
  std::vector<double> heights = {};  ///< a curve at its points; 0 where none is given

  friend bool operator==(const GivenAnswer& a, const GivenAnswer& b);
};

/// The values that the program computed for a question, and the right answers.
struct Solved {
  std::vector<double>
      values;              ///< values of choices (NaN without a value) or of patches; else empty
  std::vector<int> right;  ///< indices of the right choices, or right patches; ascending
  double value = 0;        ///< value of Question::wanted, where it is one number
  std::vector<std::vector<Vec2>> region;  ///< answer to a question for an area or an outline
  double scale = 1;  ///< area on the surface per area of `region`; `value` is on the surface
};

/// Reads the key `question` of a page.
/// @param page_state,page  the complete state of the page, as JSON and as read
/// @param folder  as for view_state_from_json()
/// @throws InputError that begins with `where`
Question question_from_json(const nlohmann::json& value, const std::string& where,
                            const nlohmann::json& page_state, const ViewState& page,
                            const std::string& folder);

/// Whether the question is about one direction: its map, its steps, or the patches above each
/// other.
bool is_of_direction(const Question& question);
/// Whether the answer is drawn: an area, an outline or a curve.
bool is_drawn(const Question& question);
/// Whether the answer is complete: a choice, a patch, a number, at least three corners, or all
/// points of a curve.
bool is_given(const Question& question, const GivenAnswer& answer);
/// Computes what is right. @throws as ComputedValues
Solved solve_question(const Question& question, ComputedValues& computed);
/// Whether a complete answer is right.
bool is_right(const Question& question, const Solved& solved, const GivenAnswer& answer);
/// How a region and a polygon over it differ, sampled on a grid to about 1 %; the polygon may cross
/// itself.
struct AreaComparison {
  double overlap = 0;  ///< the common part over the union, 0 to 1
  double missed = 0;   ///< area of the region outside the polygon, m²
  double extra = 0;    ///< area of the polygon outside the region, m²
};
AreaComparison compare_areas(const std::vector<std::vector<Vec2>>& region,
                             const std::vector<Vec2>& outline);
/// The mean distance of a curve from the computed one, in powers of ten; infinite where a value is
/// not positive.
double mean_distance(const std::vector<double>& heights, const std::vector<double>& computed);

}  // namespace transillum::viewer
