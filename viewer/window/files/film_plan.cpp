// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/film_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/scene_view.h"

namespace transillum::viewer {

namespace {

constexpr double seconds_per_film = 10;  // over a turn or a change

}  // namespace

FilmWalk::FilmWalk(const FilmPlan& plan, Focus& focus, SceneView& view, FilmedChange* change)
    : plan_(plan),
      focus_(focus),
      view_(&view),
      change_(change),
      begin_(focus.position()),
      view_point_(view.view_point()),
      followed_(focus.following()) {
  switch (plan.over) {
    case FilmPlan::Over::changes:
      break;
    case FilmPlan::Over::polygons:
      count_ = focus.map() ? focus.map()->history.step_count() + 1 : 0;
      break;
    case FilmPlan::Over::directions:
      count_ = focus.passes_of(begin_.iteration);
      break;
    case FilmPlan::Over::iterations:
      count_ = focus.iterations();
      break;
    case FilmPlan::Over::turn:
    case FilmPlan::Over::day:
    case FilmPlan::Over::move:
      count_ = static_cast<int>(std::lround(seconds_per_film * plan.per_second));
      break;
  }
  view.hold(true);
  if (change) {
    count_ = std::max(2, count_);
    change->begin_film(count_);
  }
  if (plan.over != FilmPlan::Over::turn) {
    go();
  }
}

FilmWalk::~FilmWalk() {
  if (!view_) {
    return;
  }
  if (change_) {
    change_->end_film();
  } else if (plan_.over == FilmPlan::Over::turn) {
    view_->set_view_point(view_point_);
  } else if (followed_) {
    focus_.set_following(true);
  } else {
    focus_.go_to(begin_);
  }
  view_->hold(false);
}

bool FilmWalk::arrived() {
  if (change_) {
    return !change_->busy();
  }
  if (plan_.over == FilmPlan::Over::turn) {
    return true;
  }
  if (!focus_.arrived()) {
    return false;
  }
  const RunPosition& now = focus_.position();
  const bool there = plan_.over == FilmPlan::Over::polygons     ? now.step == done_ - 1
                     : plan_.over == FilmPlan::Over::directions ? now.direction == done_
                                                                : now.iteration == done_;
  if (!there || focus_.following()) {
    go();
  }
  return there;
}

bool FilmWalk::next() {
  if (++done_ >= count_) {
    return false;
  }
  go();
  return true;
}

void FilmWalk::go() {
  constexpr auto last = std::numeric_limits<std::int32_t>::max();
  switch (plan_.over) {
    case FilmPlan::Over::changes:
      break;
    case FilmPlan::Over::polygons:
      focus_.go_to({begin_.iteration, begin_.direction, done_ - 1});
      break;
    case FilmPlan::Over::directions:
      focus_.go_to({begin_.iteration, done_, last});
      break;
    case FilmPlan::Over::iterations:
      focus_.go_to({done_, begin_.direction, last});
      break;
    case FilmPlan::Over::turn:
      view_->turn(360.0 / count_, 0);
      break;
    case FilmPlan::Over::day:
    case FilmPlan::Over::move:
      change_->show_picture(done_);
      break;
  }
}

}  // namespace transillum::viewer
