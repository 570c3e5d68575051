// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

#include "transillum/sun.h"

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace transillum::viewer {

class SettingRows;
class SunDome;

/// A place of the sun on its way through a day.
struct SunOfDay {
  QString time;  ///< 21 Jun 14:30
  Sun sun;
};

/// The sun: its irradiance, and its place in the sky, by hand or by place, day and time.
class SunControls : public QWidget {
  Q_OBJECT

 public:
  explicit SunControls(QWidget* parent = nullptr);

  /// The sun in a scene with this vertical (unit vector) and the default north.
  Sun sun(const Vec3& up) const;
  /// The sun on its way through the day that is set, in equal steps: from sunrise to sunset, or
  /// through 24 hours around noon where the sun does not set. Empty where the sun is not placed by
  /// time, or does not rise.
  /// @param count  at least 2
  std::vector<SunOfDay> day(const Vec3& up, int count) const;
  /// Shows a sun; emits nothing. sun() is it, with all digits, until the user changes something.
  void set_sun(const Sun& sun, const Vec3& up);
  /// The same, also where sun() is it: for another vertical, at which it has other angles.
  void show_sun(const Sun& sun, const Vec3& up);

 signals:
  /// The user has changed something.
  void changed();

 private:
  void add_place(SettingRows& rows);
  void take_position(const SolarPosition& position);
  void take_time();
  void show_rows();
  void show_position(const SolarPosition& position);
  SolarPosition position_at(double minute) const;
  Sun sun_at(const SolarPosition& position, const Vec3& up) const;
  void tell();

  Sun given_;                   ///< the argument of set_sun()
  bool is_given_ = true;        ///< nothing has changed since
  Rgb color_{1, 1, 1};          ///< the sun's; its largest channel is 1
  QDoubleSpinBox* irradiance_;  ///< W/m²
  SunDome* dome_;
  QWidget* angles_;
  QDoubleSpinBox *azimuth_, *elevation_;  ///< degrees
  QCheckBox* by_time_;
  QWidget* site_;
  QDoubleSpinBox *latitude_, *longitude_;  ///< degrees
  QSlider *day_, *time_;                   ///< day of the year from 0, minute of the day
  QLabel *day_label_, *time_label_;
};

}  // namespace transillum::viewer
