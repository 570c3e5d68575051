// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The table of engines: a line here and one in make_engine() for each.
#include <array>

#include "base/choice.h"
#include "transillum/at.h"
#include "transillum/engine.h"

namespace transillum {
namespace {

using Error = EngineTraits::Error;
using Picture = EngineTraits::Picture;
using Factors = EngineTraits::Factors;

constexpr std::array all_engines{
    EngineTraits{
        .value = Engine::fast,
        .name = "fast",
        .label = "Fast",
        .sentence = "Exact: subtracts the candidates from each receiver's region, nearest first",
        .has_moments = true,
        .has_linear_basis = true},
    EngineTraits{.value = Engine::local,
                 .name = "local",
                 .label = "Local map",
                 .sentence = "Exact: the local visibility map of section 3.2, which can be stepped "
                             "through",
                 .has_moments = true,
                 .has_linear_basis = true},
    EngineTraits{.value = Engine::global,
                 .name = "global",
                 .label = "Global map",
                 .sentence = "Exact, slow: the global visibility map of section 3.1, an "
                             "arrangement in rational numbers"},
    EngineTraits{.value = Engine::exact,
                 .name = "exact",
                 .label = "Exact numbers",
                 .sentence = "Exact, slow: the local map in rational numbers, without rounding; "
                             "for small scenes",
                 .has_moments = true,
                 .has_linear_basis = true},
    EngineTraits{.value = Engine::zbuffer,
                 .name = "zbuffer",
                 .label = "Z-buffer",
                 .sentence = "Each pixel of the plane has a list of patches, sorted by height "
                             "(section 2)",
                 .error = Error::own,
                 .picture = Picture::pixels,
                 .takes_resolution = true},
    EngineTraits{.value = Engine::painter,
                 .name = "painter",
                 .label = "Painter's algorithm",
                 .sentence = "Patches are painted into one pixel buffer, the farthest first "
                             "(section 2)",
                 .error = Error::own,
                 .picture = Picture::pixels,
                 .takes_resolution = true,
                 .takes_order = true},
    EngineTraits{.value = Engine::rays,
                 .name = "rays",
                 .label = "Parallel rays",
                 .sentence = "Parallel rays through the scene; each represents an equal area of "
                             "the plane",
                 .error = Error::statistical,
                 .picture = Picture::pixels,
                 .takes_resolution = true,
                 .factors = Factors::rays},
    EngineTraits{.value = Engine::corrected,
                 .name = "corrected",
                 .label = "No cutting, corrected",
                 .sentence = "Approximate: partly hidden polygons are not cut, and their light is "
                             "corrected (section 8)",
                 .error = Error::own,
                 .picture = Picture::corrected},
    EngineTraits{.value = Engine::hemicube,
                 .name = "hemicube",
                 .label = "Hemicube",
                 .sentence = "Form factors from the center of each patch through the pixels of "
                             "half a cube; uses no directions",
                 .error = Error::own,
                 .picture = Picture::hemicube,
                 .takes_directions = false,
                 .takes_resolution = true,
                 .factors = Factors::hemicubes},
    EngineTraits{.value = Engine::pairs,
                 .name = "pairs",
                 .label = "Pairs of patches",
                 .sentence = "Form factors pair by pair: exact where nothing is between, otherwise "
                             "past the shadows of blockers; uses no directions",
                 .picture = Picture::none,
                 .takes_directions = false,
                 .has_linear_basis = true,
                 .takes_points = true,
                 .factors = Factors::pairs},
};

}  // namespace

std::span<const EngineTraits> engines() { return all_engines; }

const EngineTraits& traits_of(Engine engine) { return at(all_engines, engine); }

template <>
const Choices& choices_of<Engine>() {
  return texts_of<all_engines>("engine");
}

bool takes_directions(Engine engine) { return traits_of(engine).takes_directions; }

bool has_moments(Engine engine) { return traits_of(engine).has_moments; }

}  // namespace transillum
