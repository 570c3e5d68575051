// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <string>

#include "lessons/view_state.h"
#include "model/snapshot.h"

namespace transillum::viewer::test {

/// The scene that a page is about.
inline std::shared_ptr<const LoadedScene> loaded_for(const ViewState& page) {
  auto loaded = std::make_shared<LoadedScene>();
  const SceneDescription description = describe_scene(page.scene, page.options.input.read);
  loaded->description = std::make_shared<const SceneDescription>(description);
  loaded->scene = std::make_shared<const Scene>(description, page.options.scene);
  loaded->tree = std::make_shared<const BspTree>(*loaded->scene);
  return loaded;
}

/// A page of the furnace with one question.
inline std::string page_with(const std::string& question, const std::string& text = "x") {
  return R"({"title": "T", "pages": [{"text": ")" + text +
         R"(", "show": {"scene": "furnace", "layout": "teach",
    "options": {"directions": 32, "sampling": "fibonacci"}, "focus": {"direction": 8}},
    "question": )" +
         question + "}]}";
}

}  // namespace transillum::viewer::test
