// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iosfwd>

#include "transillum/map_files.h"

namespace transillum {

// One writer per format of write_map().

void write_map_svg(std::ostream& out, const Scene& scene, const VisibilityMap& map,
                   const MapPictureOptions& options);
void write_map_png(std::ostream& out, const Scene& scene, const VisibilityMap& map,
                   const MapPictureOptions& options);
void write_map_pdf(std::ostream& out, const Scene& scene, const VisibilityMap& map,
                   const MapPictureOptions& options);
void write_map_vtp(std::ostream& out, const Scene& scene, const VisibilityMap& map);
void write_map_json(std::ostream& out, const Scene& scene, const VisibilityMap& map);

}  // namespace transillum
