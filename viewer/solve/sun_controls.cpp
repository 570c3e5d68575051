// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/sun_controls.h"

#include <QCheckBox>
#include <QDate>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <QSlider>
#include <QTime>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solve/sun_dome.h"
#include "widgets/build.h"
#include "widgets/setting_rows.h"

namespace transillum::viewer {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int minutes_of_day = 24 * 60;
constexpr double clear_day = 1000;  // W/m²

QDate first_day() { return {QDate::currentDate().year(), 1, 1}; }

/// Whole hours of the zone at a longitude, without daylight saving time.
int zone_of(double longitude) { return static_cast<int>(std::lround(longitude / 15)); }

QDoubleSpinBox* angle_box(const QString& name, double low, double high, const QString& tip) {
  auto* box = named(name, new QDoubleSpinBox, tip);
  box->setRange(low, high);
  box->setDecimals(1);
  box->setKeyboardTracking(false);
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  box->setMinimumWidth(60);
  return box;
}

QWidget* side_by_side(QWidget* left, QWidget* right) {
  auto* both = new QWidget;
  auto* row = make_row(both, {}, 6);
  row->addWidget(left, 1);
  row->addWidget(right, 1);
  return both;
}

/// A slider with the value that it stands for.
QWidget* labeled(QSlider* slider, QLabel* label, const QString& widest) {
  auto* both = new QWidget;
  auto* row = make_row(both, {}, 6);
  row->addWidget(slider, 1);
  row->addWidget(label);
  label->setMinimumWidth(label->fontMetrics().horizontalAdvance(widest));
  label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  return both;
}

SolarPosition position_of(const Vec3& direction, const Vec3& up) {
  const Vec3 north = default_north(up);
  const Vec3 ahead = normalized(north - dot(north, up) * up);
  const double azimuth =
      std::atan2(dot(direction, cross(ahead, up)), dot(direction, ahead)) / degree;
  return {azimuth < 0 ? azimuth + 360 : azimuth,
          std::asin(std::clamp(dot(direction, up), -1.0, 1.0)) / degree};
}

}  // namespace

SunControls::SunControls(QWidget* parent) : QWidget(parent) {
  irradiance_ =
      named("sun", new QDoubleSpinBox,
            tr("Irradiance of an unobstructed plane that faces the sun; 0 switches the sun off"));
  irradiance_->setRange(0, 1e6);
  irradiance_->setDecimals(1);
  irradiance_->setSpecialValueText(tr("None"));
  irradiance_->setKeyboardTracking(false);
  irradiance_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  irradiance_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  irradiance_->setMinimumWidth(60);
  dome_ = new SunDome;
  azimuth_ = angle_box("sun_azimuth", 0, 360,
                       tr("Clockwise from north: the y axis, or −z where y is the vertical"));
  azimuth_->setWrapping(true);
  elevation_ = angle_box("sun_elevation", -90, 90, tr("Above the horizon"));
  angles_ = side_by_side(azimuth_, elevation_);
  auto* rows = new SettingRows;
  rows->add(tr("Sun, W/m²"), irradiance_, irradiance_->toolTip());
  rows->add(dome_);
  rows->add(
      tr("Direction, °"), angles_,
      tr("The place of the sun in the sky: azimuth, clockwise from north, and elevation above the "
         "horizon"));
  add_place(*rows);
  make_column(this, {}, 0)->addWidget(rows);
  connect(irradiance_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this] {
    show_rows();
    tell();
  });
  connect(dome_, &SunDome::moved, this, &SunControls::take_position);
  for (QDoubleSpinBox* box : {azimuth_, elevation_}) {
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this] {
      take_position({azimuth_->value(), elevation_->value()});
    });
  }
  show_rows();
}

void SunControls::add_place(SettingRows& rows) {
  by_time_ = named("sun_by_time", new QCheckBox(tr("By place, day and time")),
                   tr("Move the sun through the day and the year of a place"));
  latitude_ = angle_box("sun_latitude", -90, 90, tr("Latitude, positive to the north"));
  latitude_->setValue(50);
  longitude_ = angle_box("sun_longitude", -180, 180, tr("Longitude, positive to the east"));
  longitude_->setValue(15);
  site_ = side_by_side(latitude_, longitude_);
  const auto slider = [](const QString& name, int last, int page, const QString& tip) {
    auto* made = named(name, new QSlider(Qt::Horizontal), tip);
    made->setRange(0, last);
    made->setPageStep(page);
    made->setMinimumWidth(60);
    return made;
  };
  day_ = slider("sun_day", 364, 30, tr("Day of this year"));
  time_ = slider("sun_time", minutes_of_day - 1, 60,
                 tr("Time of the zone, without daylight saving time"));
  time_->setSingleStep(5);
  day_->setValue(QDate(first_day().year(), 6, 21).dayOfYear() - 1);
  time_->setValue(minutes_of_day / 2);
  day_label_ = new QLabel;
  time_label_ = new QLabel;
  rows.add(by_time_);
  rows.add(tr("Place, °"), site_,
           tr("Latitude, positive to the north, and longitude, positive to the east"));
  rows.add(tr("Day"), labeled(day_, day_label_, QStringLiteral("30 Sep")), day_->toolTip());
  rows.add(tr("Time"), labeled(time_, time_label_, QStringLiteral("00:00")), time_->toolTip());
  connect(by_time_, &QCheckBox::toggled, this, [this](bool on) {
    show_rows();
    if (on) {
      take_time();
    } else {
      dome_->set_path({});
    }
  });
  for (QDoubleSpinBox* box : {latitude_, longitude_}) {
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &SunControls::take_time);
  }
  for (QSlider* one : {day_, time_}) {
    connect(one, &QSlider::valueChanged, this, &SunControls::take_time);
  }
}

void SunControls::show_rows() {
  const bool is_on = irradiance_->value() > 0;
  const bool by_time = is_on && by_time_->isChecked();
  dome_->setVisible(is_on);
  SettingRows::show_row(angles_, is_on);
  by_time_->setVisible(is_on);
  SettingRows::show_row(site_, by_time);
  SettingRows::show_row(day_->parentWidget(), by_time);
  SettingRows::show_row(time_->parentWidget(), by_time);
}

SolarPosition SunControls::position_at(double minute) const {
  const QDateTime day(first_day().addDays(day_->value()), QTime(0, 0), Qt::UTC);
  const double utc = static_cast<double>(day.toSecsSinceEpoch()) +
                     60.0 * (minute - 60 * zone_of(longitude_->value()));
  return solar_position({latitude_->value(), longitude_->value()}, utc);
}

/// Day, time or place have changed.
void SunControls::take_time() {
  constexpr int step = 10;  // minutes
  std::vector<SolarPosition> path;
  for (int minute = 0; minute <= minutes_of_day; minute += step) {
    path.push_back(position_at(minute));
  }
  dome_->set_path(std::move(path));
  const QLocale english(QLocale::English);
  day_label_->setText(english.toString(first_day().addDays(day_->value()), "d MMM"));
  time_label_->setText(QTime(0, 0).addSecs(60 * time_->value()).toString("HH:mm"));
  show_position(position_at(time_->value()));
  tell();
}

/// The sun was moved by hand.
void SunControls::take_position(const SolarPosition& position) {
  by_time_->setChecked(false);
  show_position(position);
  tell();
}

void SunControls::show_position(const SolarPosition& position) {
  const QSignalBlocker quiet_azimuth(azimuth_), quiet_elevation(elevation_);
  azimuth_->setValue(position.azimuth);
  elevation_->setValue(position.elevation);
  dome_->set_position(position);
}

void SunControls::tell() {
  is_given_ = false;
  emit changed();
}

Sun SunControls::sun(const Vec3& up) const {
  if (is_given_) {
    return given_;
  }
  return irradiance_->value() > 0 ? sun_at(dome_->position(), up) : Sun();
}

Sun SunControls::sun_at(const SolarPosition& position, const Vec3& up) const {
  Sun sun;
  sun.direction = direction_of(position, up, default_north(up));
  sun.disc = given_.disc;
  sun.below_horizon = position.elevation <= 0;
  if (!sun.below_horizon) {
    sun.irradiance = irradiance_->value() * color_;
  }
  return sun;
}

std::vector<SunOfDay> SunControls::day(const Vec3& up, int count) const {
  std::vector<SunOfDay> day;
  const auto elevation = [this](int minute) { return position_at(minute).elevation; };
  int noon = 0;
  for (int minute = 0; minute < minutes_of_day; ++minute) {
    noon = elevation(minute) > elevation(noon) ? minute : noon;
  }
  if (!(irradiance_->value() > 0) || !by_time_->isChecked() || elevation(noon) <= 0) {
    return day;
  }
  int rise = noon, set = noon;
  while (rise > noon - minutes_of_day / 2 && elevation(rise - 1) > 0) {
    --rise;
  }
  while (set < noon + minutes_of_day / 2 && elevation(set + 1) > 0) {
    ++set;
  }
  const QDateTime midnight(first_day().addDays(day_->value()), QTime(0, 0), Qt::UTC);
  for (int k = 0; k < count; ++k) {
    const double minute = rise + (set - rise) * k / (count - 1.0);
    const QDateTime time = midnight.addSecs(std::lround(60 * minute));
    day.push_back(
        {QLocale(QLocale::English).toString(time, "d MMM HH:mm"), sun_at(position_at(minute), up)});
  }
  return day;
}

void SunControls::set_sun(const Sun& sun, const Vec3& up) {
  if (sun != this->sun(up)) {  // else how its place was found stays
    show_sun(sun, up);
  }
}

void SunControls::show_sun(const Sun& sun, const Vec3& up) {
  given_ = sun;
  is_given_ = true;
  const QSignalBlocker quiet(irradiance_), quiet_time(by_time_);
  if (!sun.below_horizon) {  // at night, the irradiance of the day stays
    const double largest = max_abs(sun.irradiance);
    color_ = largest > 0 ? (1 / largest) * sun.irradiance : Rgb{1, 1, 1};
    const bool is_weak = largest > 0 && largest < 0.1;  // would be shown as none
    irradiance_->setDecimals(is_weak ? 2 + static_cast<int>(std::ceil(-std::log10(largest))) : 1);
    irradiance_->setValue(largest);
  } else if (!(irradiance_->value() > 0)) {
    irradiance_->setValue(clear_day);  // a session at night has none
  }
  if (sun.is_set() || sun.below_horizon) {
    by_time_->setChecked(false);
    dome_->set_path({});
    show_position(position_of(sun.direction, up));
  }
  show_rows();
}

}  // namespace transillum::viewer
