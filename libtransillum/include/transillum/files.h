// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Files of results, form factors and pictures. Every writer of the library writes a temporary file
// in the same folder and renames it: a file exists completely or not at all. Numbers read back bit
// for bit. Writers throw std::runtime_error naming the file if it cannot be written. Columns:
// data/FILES.md.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/choice.h"
#include "transillum/directions.h"
#include "transillum/export.h"
#include "transillum/form_factors.h"
#include "transillum/run_options.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/transfers.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

struct Picture;
class LightMap;

/// Writes `path` through a temporary file in the same folder. A symbolic link stays, and what it
/// refers to is written, whether that exists or not. A device, and an open file of this process
/// (such as /dev/stdout or /dev/fd/3), is written to directly, at its current position.
/// @param path the file to write.
/// @param write fills the stream; if it throws, no file is left behind.
/// @throws std::runtime_error if the file cannot be written.
void write_file_whole(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write);

/// The MTL file that write_obj() writes beside an OBJ file: the same stem.
std::filesystem::path materials_file_of(const std::filesystem::path& obj);
/// Writes the description as OBJ, and its materials in materials_file_of(path).
/// @throws InputError where either is one of SceneDescription::files; std::runtime_error if a file
/// cannot be written.
void write_obj(const std::filesystem::path& path, const SceneDescription& description);

/// Checks, before a long computation, that a file can be written.
/// @throws InputError where `path` is a folder, a pipe, a loop of links or write-protected, or its
/// folder is missing or not writable.
void check_writable(const std::filesystem::path& path);
/// Checks that no output is the same file as an input or another output, by whatever paths and
/// links. Files that do not exist yet are the same if folder and name are. Devices and pipes may
/// be outputs several times.
/// @throws InputError naming both.
void check_distinct(const std::vector<std::string>& outputs,
                    const std::vector<std::string>& inputs);

/// How radiosity is shown in files for other programs.
struct DisplayOptions {
  /// Linear color per radiosity, m²/W, > 0: where B times it is 1, the color is white. If unset,
  /// automatic_exposure() gives it.
  std::optional<double> exposure = std::nullopt;
  /// .glb, .gltf: the direction, a unit vector, that becomes their up, +y; if unset, coordinates
  /// stay.
  std::optional<Vec3> up = std::nullopt;
  /// .glb, .gltf: colors as a picture (8 bits, sRGB) with texture coordinates, a square of it per
  /// patch, instead of a color per corner.
  bool light_map = false;
  /// .glb, .gltf with `light_map`: the picture, of the solution that is written, instead.
  std::shared_ptr<const LightMap> sharp_map = nullptr;

  /// @throws InputError naming the value and its range.
  void validate() const;
};
/// The exposure at which B becomes white where it exceeds B on 98 % of the area that does not emit
/// (of all area, where all emits); 1 without light.
double automatic_exposure(const Solution& solution);

/// Checks that `path` is writable and ends in .csv, .vtp, .ply, .glb or .gltf.
/// @throws InputError
void check_result_path(const std::filesystem::path& path);
/// Checks that `path` is writable and ends in .json.
/// @throws InputError
void check_statistics_path(const std::filesystem::path& path);
/// Writes a solution in the format given by the extension of `path`.
/// @param path the file.
/// @param solution the solution.
/// @param display colors in .ply, .glb and .gltf files.
/// @throws InputError for another extension, or where `path` is a file of the scene;
/// std::runtime_error if it cannot be written.
void write_result(const std::filesystem::path& path, const Solution& solution,
                  const DisplayOptions& display = {});

/// Results as a series for ParaView: a .pvd file that lists .vtp files beside it.
class ResultSeries {
 public:
  /// @param path ending in .pvd.
  /// @throws InputError for another ending, or where it cannot be written.
  explicit ResultSeries(std::filesystem::path path);
  /// Checks that none of these files, inputs and other outputs, is one that the series writes.
  /// @throws InputError naming it.
  void check_apart_from(const std::vector<std::string>& files) const;
  /// Writes the next result, STEM-0001.vtp and so on, and the .pvd file with all of them.
  /// @param solution the result.
  /// @param time its place in the series, such as the number of the iteration.
  /// @throws InputError, std::runtime_error as write_result()
  void add(const Solution& solution, double time);

 private:
  std::filesystem::path path_;
  std::vector<double> times_;
};

/// Writes a solution as CSV, as write_result() does to a file.
void write_result_csv(std::ostream& out, const Solution& solution);

/// Whether `path` ends in .vtp, the format that read_result() reads, and is not a scene: a file
/// without an array B. Reads the file's beginning.
bool is_result_file(const std::filesystem::path& path);
/// Reads a solution written by write_result() to a .vtp file: the same patches with the same E,
/// rho, B and H, bit for bit, and the same Patch::face. Statistics and error estimate contain what
/// the file stores.
/// @throws InputError naming the file and what is wrong with it
/// @throws Canceled
Solution read_result(const std::filesystem::path& path, const Cancellation& cancellation = {});

/// Columns receiver,source,area; source -1: nothing above, or a back side. Direction omega only.
void write_transfers_csv(std::ostream& out, const Transfers& transfers);
/// Columns i,j,F; rows sorted by i, then j.
void write_form_factors_csv(std::ostream& out, const FormFactors& form_factors);
/// Columns u,v,x,y,z.
void write_directions_csv(std::ostream& out, const std::vector<DirectionSample>& directions);

/// Writes options and statistics of a solve run as JSON. The options of the scene come from the
/// scene of `solution`.
/// @throws std::runtime_error if it cannot be written.
void write_statistics(const std::filesystem::path& path, const RunOptions& options,
                      const Solution& solution);

/// Form factors read from a file.
struct StoredFormFactors {
  std::string name;           ///< name of the file, for error messages
  FormFactors form_factors;   ///< rows sorted by source, values > 0
  std::vector<double> areas;  ///< areas of the patches, m²; empty if the file has none
  std::string polygons;       ///< hash of the corners of all patches; empty: the file has none
};

/// Checks that `path` is writable and ends in .csv, .npz, .mtx or .vf, or has no ending, which
/// means .csv.
/// @throws InputError
void check_form_factor_path(const std::filesystem::path& path);
/// Writes form factors in the format given by the extension of `path`: .csv (i,j,F), .npz (a
/// compressed sparse row matrix as scipy.sparse.load_npz() reads it), .mtx (Matrix Market), .vf
/// (the text form of View3D: a dense matrix). All but .vf also have FormFactors::moments, if any.
/// @param path the file.
/// @param scene whose areas .npz, .mtx and .vf files hold, whose polygons' hash .npz and .mtx
/// files, and whose reflectances .vf files.
/// @param form_factors of `scene`.
/// @throws InputError for another extension, where the matrix is too large for the format, or for
/// moments in a .vf file
/// @throws std::runtime_error if the file cannot be written.
void write_form_factors(const std::filesystem::path& path, const Scene& scene,
                        const FormFactors& form_factors);

/// Whether `path` ends in .npz or .mtx.
bool is_form_factor_file(const std::filesystem::path& path);
/// Reads form factors from a .npz or .mtx file, by write_form_factors() or another program.
/// @throws InputError naming the file and what is wrong with it
/// @throws Canceled
StoredFormFactors read_form_factors(const std::filesystem::path& path,
                                    const Cancellation& cancellation = {});
/// Checks that form factors belong to a scene: the number of patches; their areas, to 1e-9; in
/// files without areas, that A_i F_ij and A_j F_ji differ by at most 10 % on average; the hash of
/// the polygons, without which an object that has moved is not noticed.
/// @throws InputError naming the file and the difference.
void check_form_factors(const Scene& scene, const StoredFormFactors& stored);

/// How exposed light becomes a color.
enum class ToneCurve {
  linear,  ///< proportional; what is brighter than white keeps its hue
  aces,    ///< film curve of ACES, as fitted by K. Narkowicz (2016)
  filmic,  ///< film curve of J. Hable (2010), white at 11.2 after an exposure of 2
};
/// @returns the texts of tone curves.
template <>
const Choices& choices_of<ToneCurve>();

/// Colors of a picture on a screen.
struct PictureLook {
  /// Linear color per radiosity, m²/W, > 0: pi times the radiance, which is B of a diffuse surface,
  /// times it is 1 where a linear picture becomes white.
  double exposure = 1;
  ToneCurve tone = ToneCurve::linear;  ///< from exposed light to linear color

  /// @throws InputError naming the value and its range.
  void validate() const;
};
/// The linear color in which a radiance is shown, each channel from 0 to 1.
Rgb shown_color(const Rgb& radiance, const PictureLook& look);

/// A scale of false colors for pi times the radiance, by its luminance (Rec. 709).
struct FalseColors {
  double highest = 1;  ///< upper end of the scale, W/m², > 0; the lower end is 0
  /// The picture has PictureOptions::irradiance, and the scale says illuminance, lux, at 683 lm/W;
  /// else it says B, W/m².
  bool lux = false;

  /// @throws InputError naming the value and its range.
  void validate() const;
};

/// Whether `path` ends in .png, .exr or .pfm.
bool is_picture_file(const std::filesystem::path& path);
/// Whether `path` ends in .png: such a file has the colors of a PictureLook or FalseColors.
bool is_screen_picture(const std::filesystem::path& path);
/// Checks, before a long computation, that `path` is writable and ends in .png, .exr or .pfm.
/// @throws InputError
void check_picture_path(const std::filesystem::path& path);
/// Writes a picture in the format given by the extension of `path`, completely or not at all.
///
/// - .png: 8 bits a channel, sRGB.
/// - .exr: OpenEXR, channels R, G, B of 32-bit floating-point numbers: radiance, W/(m² sr).
/// - .pfm: the same numbers as a portable float map, little-endian, rows from the bottom.
/// @param path the file.
/// @param picture the picture.
/// @param look of .png files.
/// @throws InputError as check_picture_path(), for a look out of range, or a picture without its
/// pixels; std::runtime_error if the file cannot be written.
void write_picture(const std::filesystem::path& path, const Picture& picture,
                   const PictureLook& look = {});
/// Writes a .png file of the picture in false colors, with a labeled scale on its right, which
/// makes it wider.
/// @throws InputError, std::runtime_error as write_picture()
void write_false_colors(const std::filesystem::path& path, const Picture& picture,
                        const FalseColors& colors);

}  // namespace TRANSILLUM_API transillum
