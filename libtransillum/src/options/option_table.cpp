// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The only place that knows an option: a line here, and one in conflicts.cpp if it excludes
// another.
#include "options/option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/memory_limit.h"
#include "options/option_kinds.h"
#include "transillum/errors.h"
#include "transillum/first_shot.h"

namespace transillum {
namespace {

using namespace option_kinds;

constexpr int largest_count = 1'000'000;
constexpr std::int64_t most_patches = 50'000'000;

/// A change of a material, of which there may be several.
void change(Option& o, MaterialChange (*from_text)(const std::string&)) {
  o.in_files = false;  // files have a list of all changes, in their order
  o.reads_scene = true;
  o.repeats = true;
  o.parse = [=](RunOptions& options, const std::string& text) {
    options.input.changes.push_back(from_text(text));
  };
  o.print = [](const RunOptions&) { return std::string(); };
}

/// A direction; a unit vector keeps its bits.
Vec3 unit_vector_from_text(const std::string& text) {
  const Vec3 direction = direction_from_text(text), given = point_from_text(text);
  return std::abs(norm(given) - 1) < 1e-12 ? given : direction;
}

bool is_reflectance(double value) { return value >= 0 && value < 1; }
bool is_positive(double value) { return value > 0; }

/// Makes options, and adds them to the list.
class Table {
 public:
  std::vector<Option> list;
  std::string section;

  Option& add(const char* name, const char* argument, const char* values, std::string help) {
    Option& o = list.emplace_back();
    o.name = name;
    o.section = section;
    o.argument = argument;
    o.values = values;
    o.help = std::move(help);
    return o;
  }
  Option& common(const char* name, const char* argument, const char* values, std::string help) {
    Option& o = add(name, argument, values, std::move(help));
    o.common = true;
    return o;
  }
  /// Gives all options from number `first` on this property.
  void mark(std::size_t first, bool Option::*property) {
    for (std::size_t k = first; k < list.size(); ++k) {
      list[k].*property = true;
    }
  }
};

void add_directions(Table& t) {
  t.section = "Directions";
  Option& directions =
      t.common("directions", "M", "a number", "number of directions per iteration (one pass each)");
  whole(directions, solve(&SolveOptions::directions), 1, 1 << 24);
  directions.letter = 'm';
  Option& sampling = t.common(
      "sampling", "NAME", "a name",
      "set of directions (section 4 of the paper); of one-way passes fibonacci by default");
  sampling.choices = names_of<Sampling>();
  sampling.lists_choices = true;
  sampling.parse = [](RunOptions& o, const std::string& text) {
    o.solve.sampling = from_name<Sampling>(text);
  };
  sampling.print = [](const RunOptions& o) { return name_of(o.solve.used_sampling()); };
  Option& seed =
      t.add("seed", "S", "a number",
            "random seed of random, sobol and scrambled-hammersley directions, and of the engine "
            "rays");
  seed.json = Option::Json::number;
  seed.parse = [](RunOptions& o, const std::string& text) { o.solve.seed = seed_from_text(text); };
  seed.print = [](const RunOptions& o) { return fmt::to_string(o.solve.seed); };
  Option& rotate = t.add("rotate", "S", "a number, or none",
                         "apply a random rotation with this seed to all directions");
  rotate.json = Option::Json::number;
  optional(rotate, solve(&SolveOptions::rotation), "none", seed_from_text,
           [](std::uint64_t value) { return fmt::to_string(value); });
  Option& one_way = t.add("one-way", "", "yes or no",
                          "use each pass for one direction, as in the paper, instead of for it "
                          "and its opposite");
  flag(one_way, solve(&SolveOptions::two_way), false);
}

void add_engine(Table& t) {
  t.section = "Engine";
  const auto engine = [](auto m) { return solve(&SolveOptions::engine_options, m); };
  Option& name =
      t.common("engine", "NAME", "a name", "algorithm that computes visibility along a direction");
  choice(name, solve(&SolveOptions::engine));
  name.lists_choices = true;
  Option& resolution =
      t.add("resolution", "R", "a number, or auto",
            "zbuffer and painter: pixels along the longer side of the projected scene; rays: lines "
            "along that side, instead of a number per patch; hemicube: pixels along a side of the "
            "cube, even");
  whole(resolution, engine(&EngineOptions::resolution), 1, EngineOptions::largest_resolution,
        "auto");
  resolution.default_text = fmt::format("{}, hemicube 64", EngineOptions::default_resolution);
  Option& points =
      t.add("points", "P", "a number, or auto",
            "engine pairs and first shot: number of points along a patch as large as its distance "
            "from the other, where something is between");
  whole(points, engine(&EngineOptions::points), 1, EngineOptions::largest_points, "auto");
  points.default_text = fmt::to_string(EngineOptions::default_points);
  Option& order =
      t.add("order", "NAME", "a name",
            "engine painter: order of the patches (newell fails if patches overlap in a cycle)");
  choice(order, engine(&EngineOptions::order));
  order.lists_choices = true;
}

void add_equations(Table& t) {
  t.section = "Iteration";
  choice(t.add("normalize", "NAME", "a name", meanings<Normalization>()),
         solve(&SolveOptions::normalize));
  choice(t.add("scheme", "NAME", "a name", meanings<Scheme>()), solve(&SolveOptions::scheme));
  Option& basis = t.common("basis", "NAME", "a name", meanings<Basis>());
  choice(basis, solve(&SolveOptions::basis));
  basis.reads_factors = true;
  flag(t.add("glossy", "", "yes or no",
             "lobes of materials (MTL: Ks with Ns or Pr; glTF: metallic and rough) reflect too"),
       solve(&SolveOptions::glossy));
  Option& shot =
      t.add("first-shot", "RATIO", "none, auto or a number",
            "treat small bright sources separately before the iteration: those with R2/A of at "
            "least this ratio, R the scene's diagonal and A the source's area; auto: those for "
            "which it takes less time than the passes it saves, none with lobes");
  shot.json = Option::Json::number;
  shot.choices = {"none", "auto"};
  shot.unset = "none";
  shot.parse = [](RunOptions& o, const std::string& text) {
    try {
      o.solve.first_shot = first_shot_from_name(text);
    } catch (const InputError&) {
      throw InputError(fmt::format("\"{}\" is not none, auto or a number of at least 0", text));
    }
  };
  shot.print = [](const RunOptions& o) { return name_of_first_shot(o.solve.first_shot); };
  Option& burn_in =
      t.add("burn-in", "N", "a number, or auto",
            "semi-iterative: first iterations to exclude from the mean; auto: until what is left "
            "of the start counts for less than the differences between iterations");
  burn_in.json = Option::Json::number;
  burn_in.choices = {"auto"};
  optional(
      burn_in, solve(&SolveOptions::burn_in), "auto",
      [](const std::string& text) {
        return static_cast<int>(whole_number_from_text(text, 0, largest_count));
      },
      [](int value) { return fmt::to_string(value); });
  Option& iterations =
      t.add("iterations", "K", "a number, or none", "stop after this many iterations");
  whole(iterations, solve(&SolveOptions::iterations), 1, largest_count, "none");
  iterations.reads_factors = true;
  Option& tolerance =
      t.common("tolerance", "T", "a number",
               "stop when the light not yet propagated is at most this fraction of the reflected "
               "light, of all patches and of the dimmest tenth of their area; semi-iterative: "
               "when the estimated error of the mean, 95 % confidence, is at most that");
  real(
      tolerance, solve(&SolveOptions::tolerance), [](double x) { return x > 0 && x < 1; },
      "greater than 0 and less than 1");
  tolerance.reads_factors = true;
}

void add_accuracy(Table& t) {
  t.section = "Accuracy";
  const auto goal = [](auto m) { return solve(&SolveOptions::goal, m); };
  percentage(t.common("accuracy", "P%|X", "a percentage or a number, or none",
                      "choose M and the replicas so that the error of B is at most this, with 95 % "
                      "confidence; 1 % where no directions are given"),
             goal(&AccuracyGoal::accuracy));
  Option& of =
      t.add("accuracy-of", "NAME", "a name",
            "error that the accuracy limits, relative to reflected light, B - E, without patches "
            "that emit: surfaces, the RMS error of each group (material, connected component) over "
            "its own RMS, the worst of all; groups:NAME,..., the same of these groups; irradiance, "
            "the same of H; rms, of all surfaces together; max, the largest error over the largest "
            "value; patch:I, the error of patch I; mean, the error of the mean; each in the color "
            "channel that is off the most");
  of.choices = {"surfaces", "groups:NAME,...", "irradiance", "rms", "max", "patch:I", "mean"};
  of.lists_choices = true;
  of.parse = [](RunOptions& o, const std::string& text) {
    AccuracyGoal named;
    try {
      named = accuracy_of_from_name(text);
    } catch (const InputError&) {
      throw InputError(fmt::format(
          "\"{}\" is not surfaces, irradiance, rms, max, mean, patch:I, where I is the number of a "
          "patch, or groups:NAME,...",
          text));
    }
    o.solve.goal.of = named.of;
    o.solve.goal.patch = named.patch;
    o.solve.goal.surfaces = named.surfaces;
  };
  of.print = [](const RunOptions& o) { return name_of_accuracy(o.solve.goal); };
  real(t.add("seconds", "S", "a number, or none",
             "time limit in s, loading excluded: the most accurate result that it allows"),
       goal(&AccuracyGoal::seconds), is_positive, "greater than 0", "none");
  whole(t.add("most-passes", "N", "a number, or none",
              "an accuracy ends after this many passes in all; 16384 for the default accuracy"),
        goal(&AccuracyGoal::passes), 1, std::int64_t{1} << 40, "none");
  Option& paper =
      t.add("paper", "", "yes or no",
            "the paper's choices for all that is not given: 1024 one-way Hammersley directions, "
            "constant functions, no first shot, no accuracy");
  flag(paper, member(&RunOptions::paper), true);
  paper.in_files = false;
  Option& replicas = t.add("replicas", "R", "a number",
                           "split M into this many rotated sets; their spread gives error bars");
  whole(replicas, solve(&SolveOptions::replicas), 1, 64);
  replicas.default_text = "1: no error estimate";
}

void add_sky(Table& t) {
  t.section = "Sky";
  Option& sky =
      t.common("sky", "E[,E,E]", "one number or three, W/m2, or none",
               "light that leaves an open scene meets a sky: irradiance of an unobstructed "
               "patch turned upward, in W/m2");
  sky.json = Option::Json::numbers;
  sky.zero_is_unset = true;
  sky.unset = "none";
  sky.default_text = "no sky";
  sky.parse = [](RunOptions& o, const std::string& text) {
    o.solve.sky.exitance = text == "none" ? Rgb{} : exitance_from_text(text);
  };
  sky.print = [](const RunOptions& o) {
    return o.solve.sky.is_bright() ? exact_text(o.solve.sky.exitance) : "none";
  };
  Option& model =
      t.add("sky-model", "NAME", "a name",
            "uniform: the same from everywhere, also from below; cie-overcast: three times as "
            "bright at the zenith as at the horizon, nothing from below");
  choice(model, solve(&SolveOptions::sky, &Sky::model));
  model.lists_choices = true;
  Option& up =
      t.add("up", "X,Y,Z", "a direction x,y,z",
            "the vertical: the zenith of the sky cie-overcast, and of azimuths and elevations");
  up.json = Option::Json::numbers;
  up.reads_factors = true;  // result files have it, too
  up.parse = [](RunOptions& o, const std::string& text) {
    o.solve.sky.up = unit_vector_from_text(text);
  };
  up.print = [](const RunOptions& o) { return exact_text(o.solve.sky.up); };
}

/// The sun by its direction, as files have it.
void add_sun(Table& t) {
  Option& direction =
      t.add("sun-direction", "X,Y,Z", "a direction x,y,z, or none", "direction toward the sun");
  direction.json = Option::Json::numbers;
  direction.unset = "none";
  direction.parse = [](RunOptions& o, const std::string& text) {
    o.solve.sky.sun.direction = text == "none" ? Vec3{} : unit_vector_from_text(text);
  };
  direction.print = [](const RunOptions& o) {
    const Vec3& toward_sun = o.solve.sky.sun.direction;
    return toward_sun == Vec3{} ? std::string("none") : exact_text(toward_sun);
  };
  Option& irradiance = t.add("sun-irradiance", "W[,W,W]", "one number or three, W/m2, or none",
                             "irradiance by the sun of a plane perpendicular to its direction, in "
                             "W/m2");
  irradiance.json = Option::Json::numbers;
  irradiance.zero_is_unset = true;
  irradiance.unset = "none";
  irradiance.default_text = "no sun";
  irradiance.parse = [](RunOptions& o, const std::string& text) {
    o.solve.sky.sun.irradiance = text == "none" ? Rgb{} : exitance_from_text(text);
  };
  irradiance.print = [](const RunOptions& o) {
    const Sun& sun = o.solve.sky.sun;
    return sun.is_set() ? exact_text(sun.irradiance) : std::string("none");
  };
  flag(t.add("sun-disc", "", "yes or no",
             "the sun is a disc of 0.53 degrees: shadows have a penumbra"),
       solve(&SolveOptions::sky, &Sky::sun, &Sun::disc));
}

/// The sun by angles, or by place and time. Files have the direction that results.
void add_sun_place(Table& t) {
  const std::size_t first = t.list.size();
  t.common("sun", "AZ,EL,W[,W,W]", "azimuth, elevation and irradiance",
           "the sun: azimuth in degrees clockwise from north, elevation above the horizon, and "
           "irradiance of a plane perpendicular to its direction, in W/m2; requires --up")
      .parse = [](RunOptions& o, const std::string& text) {
    const auto [position, irradiance] = sun_from_text(text);
    o.sun.position = position;
    o.solve.sky.sun.irradiance = irradiance;
  };
  t.add("site", "LAT,LON", "latitude and longitude in degrees",
        "the sun as seen from this place at a time; north and east are positive; requires --up")
      .parse = [](RunOptions& o, const std::string& text) { o.sun.site = site_from_text(text); };
  t.add("time", "TIME", "a time with its zone",
        "time in ISO 8601 with a zone, such as 2026-06-21T14:00+02:00, for --site")
      .parse = [](RunOptions& o, const std::string& text) { o.sun.time = time_from_text(text); };
  Option& north = t.add("north", "X,Y,Z", "a direction x,y,z", "direction toward the north");
  north.default_text = "0,1,0; where up is along y, 0,0,-1";
  north.parse = [](RunOptions& o, const std::string& text) {
    o.sun.north = direction_from_text(text);
  };
  for (std::size_t k = first; k < t.list.size(); ++k) {
    t.list[k].in_files = false;
    t.list[k].print = [](const RunOptions&) { return std::string(); };
  }
}

void add_patches(Table& t) {
  t.section = "Patches";
  const std::size_t first = t.list.size();
  flag(t.common("two-sided", "", "yes or no",
                "every face emits and receives on both sides: two opposite patches per face"),
       member(&RunOptions::scene, &SceneOptions::two_sided));
  Option& area = t.common("max-patch-area", "A", "m2, or none",
                          "divide faces into patches of at most this area, in m2");
  real(area, member(&RunOptions::scene, &SceneOptions::max_patch_area), is_positive,
       "greater than 0", "none");
  area.default_text = "no limit";
  Option& patches =
      t.common("patches", "N", "a number, or none",
               "divide faces into about N patches, by a limit of their area that is chosen for it; "
               "with --refine-by and --total: the most patches to make");
  patches.json = Option::Json::number;
  patches.zero_is_unset = true;
  patches.unset = "none";
  patches.parse = [](RunOptions& o, const std::string& text) {
    o.input.patches = text == "none" ? 0 : whole_number_from_text(text, 1, most_patches);
    o.refine.patches = static_cast<int>(o.input.patches);
  };
  patches.print = [](const RunOptions& o) {
    // A file may have a limit for rounds that are not chosen yet.
    const bool by_area = !o.refine.is_set() && !o.total && o.input.patches > 0;
    const std::int64_t number = by_area ? o.input.patches : o.refine.patches;
    return number == 0 ? "none" : fmt::to_string(number);
  };
  t.mark(first, &Option::reads_factors);
  t.section = "Refinement";
  Option& by = t.add("refine-by", "NAME", "a name, or none",
                     "divide faces in rounds, worst patches first, until there are as many patches "
                     "as asked for; jump: where B jumps across edges; error: where a solve with "
                     "every patch divided differs most");
  by.choices = names_of<RefineBy>();
  optional(by, member(&RunOptions::refine, &RefineChoice::by), "none", from_name<RefineBy>,
           name_of<RefineBy>);
  percentage(t.add("refine-until", "P%|X", "a percentage or a number, or none",
                   "end the rounds when their figure is this small: relative RMS jump, or relative "
                   "L2 error"),
             member(&RunOptions::refine, &RefineChoice::until));
  flag(t.add("total", "", "yes or no",
             "the accuracy limits the sum of the errors by directions, patches, iterations and "
             "method: patches are divided and directions added until the worst surface is within "
             "it; at most --patches N"),
       member(&RunOptions::total));
}

/// Marks those that only a scene's file has.
void add_reading(Table& t) {
  t.section = "Scene";
  const std::size_t first = t.list.size();
  const auto read = [](auto m) { return member(&RunOptions::input, &SceneInput::read, m); };
  real(t.add("default-reflectance", "R", "a number",
             "reflectance where a file defines none: missing, undefined or nameless materials, "
             "unreadable textures"),
       read(&ReadOptions::default_reflectance), is_reflectance, "at least 0 and below 1");
  Option& most = t.add("max-reflectance", "R", "a number, or auto",
                       "lower larger reflectances of a file to R");
  most.json = Option::Json::number;
  most.default_text = fmt::format("lower only reflectances of 1 and more, to {}",
                                  ReadOptions::default_max_reflectance);
  optional(
      most, read(&ReadOptions::max_reflectance), "auto",
      [](const std::string& text) {
        const double value = number_from_text(text);
        if (!is_reflectance(value)) {
          throw InputError(fmt::format("\"{}\" is not at least 0 and below 1", text));
        }
        return value;
      },
      [](double value) { return exact_text(value); });
  real(t.add("scale", "X", "a number", "meters per unit of the scene's coordinates"),
       read(&ReadOptions::scale), is_positive, "greater than 0");
  Option& units = t.common("units", "NAME", "a name", "unit of the scene's coordinates");
  units.choices = length_unit_names();
  units.lists_choices = true;
  units.default_text = "m";
  units.in_files = false;
  units.parse = [](RunOptions& o, const std::string& text) {
    o.input.read.scale = length_unit_from_name(text);
  };
  units.print = [](const RunOptions&) { return std::string(); };
  Option& join = t.add("join", "", "yes, no or auto",
                       "join faces of one plane, material and group that share edges");
  join.json = Option::Json::flag;
  join.choices = {"yes", "no"};
  join.unset = "auto";
  join.default_text = "only for glTF and STL, which have triangles alone";
  join.parse = [](RunOptions& o, const std::string& text) {
    if (text != "yes" && text != "no" && text != "auto") {
      throw InputError(fmt::format("\"{}\" is not yes, no or auto", text));
    }
    o.input.read.join = text == "auto" ? std::optional<bool>() : text == "yes";
  };
  join.print = [](const RunOptions& o) {
    const auto& value = o.input.read.join;
    return std::string(!value ? "auto" : *value ? "yes" : "no");
  };
  flag(t.add("photometric", "", "yes or no",
             "glTF: emissive colors are luminances in cd/m2 instead of radiances: divide by 683 "
             "lm/W"),
       read(&ReadOptions::photometric));
  Option& orient =
      t.common("orient", "NAME", "a name",
               "auto: turn parts of the scene so that what is seen is the lit side, and make open "
               "sheets two-sided; keep: as in the file");
  orient.choices = {"keep", "auto"};
  orient.parse = [](RunOptions& o, const std::string& text) {
    if (text != "keep" && text != "auto") {
      throw InputError(fmt::format("\"{}\" is neither keep nor auto", text));
    }
    o.input.orient = text == "auto";
  };
  orient.print = [](const RunOptions& o) { return std::string(o.input.orient ? "auto" : "keep"); };
  Option& solids =
      t.add("solids", "NAME", "a name",
            "union: unite closed parts that cross or touch, and remove what is inside them; keep: "
            "as in the file");
  solids.choices = {"keep", "union"};
  solids.parse = [](RunOptions& o, const std::string& text) {
    if (text != "keep" && text != "union") {
      throw InputError(fmt::format("\"{}\" is neither keep nor union", text));
    }
    o.input.unite_solids = text == "union";
  };
  solids.print = [](const RunOptions& o) {
    return std::string(o.input.unite_solids ? "union" : "keep");
  };
  Option& divide =
      t.add("divide", "PATCHES", "names of surfaces or numbers of patches, or none",
            "divide each patch of a surface into about four; all: of all surfaces; patch:3,7-20: "
            "these patches; shadows:X,Y,Z: along the edges of shadows, X,Y,Z being the direction "
            "to the light; "
            "several with ; between them are divided one after the other");
  divide.unset = "none";
  divide.parse = [](RunOptions& o, const std::string& text) {
    o.input.divided.clear();
    for (std::size_t begin = 0; text != "none" && begin <= text.size();) {
      const std::size_t end = std::min(text.find(';', begin), text.size());
      o.input.divided.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  };
  divide.print = [](const RunOptions& o) {
    return o.input.divided.empty() ? std::string("none")
                                   : fmt::format("{}", fmt::join(o.input.divided, ";"));
  };
  change(t.common("emission", "NAME=E[,E,E]", "a name and one number or three",
                  "exitance of a material, a group or face:N, in W/m2; may be given several times"),
         exitance_change);
  change(t.common("reflectance", "NAME=R[,R,R]", "a name and one number or three",
                  "reflectance of a material, a group or face:N; may be given several times"),
         reflectance_change);
  change(t.add("lobe", "NAME=K,N", "a name and two numbers or four",
               "lobe of a material, a group or face:N, for --glossy: the share K of the light that "
               "it reflects (or R,G,B,N) and the exponent N of Phong's cosine; may be given "
               "several times"),
         lobe_change);
  t.mark(first, &Option::reads_scene);
  t.mark(first, &Option::reads_factors);
}

void add_machine(Table& t) {
  t.section = "Machine";
  const std::size_t first = t.list.size();
  Option& memory =
      t.add("memory", "SIZE", "a size such as 2G or 800M",
            "memory for stored form factors; beyond it they are recomputed in each iteration, "
            "which changes last digits");
  memory.json = Option::Json::number;
  memory.zero_is_unset = true;
  memory.unset = "auto";
  memory.default_text = "a quarter of the machine's";
  memory.parse = [](RunOptions& o, const std::string& text) {
    // To the library, 0 means the default; here it means that nothing is stored.
    o.solve.memory = text == "auto" ? 0 : std::max<std::uint64_t>(1, memory_size_from_text(text));
  };
  memory.print = [](const RunOptions& o) {
    return o.solve.memory == 0 ? "auto" : fmt::to_string(o.solve.memory);
  };
  Option& threads =
      t.common("threads", "N", "a number", "number of threads; results do not depend on it");
  whole(threads, solve(&SolveOptions::threads), 1, 4096, "all");
  threads.default_text = "all cores";
  threads.reads_factors = true;
  t.mark(first, &Option::of_machine);
}

std::vector<Option> all_options() {
  Table table;
  add_directions(table);
  add_engine(table);
  add_equations(table);
  add_accuracy(table);
  add_sky(table);
  const std::size_t sun = table.list.size();
  add_sun(table);
  add_sun_place(table);
  table.mark(sun, &Option::reads_factors);
  add_patches(table);
  add_reading(table);
  add_machine(table);
  return std::move(table.list);
}

}  // namespace

const std::vector<Option>& options() {
  static const std::vector<Option> all = all_options();
  return all;
}

const Option& option(const std::string& name) {
  const auto found = std::find_if(options().begin(), options().end(),
                                  [&](const Option& o) { return o.name == name; });
  if (found == options().end()) {
    throw std::out_of_range("there is no option " + name);
  }
  return *found;
}

std::string Option::default_value() const {
  return default_text.empty() ? print(RunOptions{}) : default_text;
}

std::string Option::help_text() const {
  std::string text = help;
  if (lists_choices) {
    text += fmt::format(": {}", fmt::join(choices, " | "));
  }
  const std::string value = default_value();
  const bool tells = !value.empty() && value != "none" && !(is_flag() && value == "no");
  return tells ? fmt::format("{} (default {})", text, value) : text;
}

std::uint64_t default_memory_limit() { return memory_limit(0); }

}  // namespace transillum
