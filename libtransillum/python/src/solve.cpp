// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <pybind11/stl.h>

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "interrupt.h"

namespace transillum::python {
namespace {

using ScenePtr = std::shared_ptr<Scene>;

py::dict to_dict(const SolveProgress& progress) {
  py::dict dict;
  dict["iteration"] = progress.iteration;
  dict["direction"] = progress.direction;
  dict["passes"] = progress.passes;
  dict["finished"] = progress.finished;
  dict["change"] = progress.change;
  dict["passes_per_second"] = progress.passes_per_second;
  dict["seconds_left"] = progress.seconds_left;
  dict["stage"] = progress.stage == SolveProgress::Stage::passes          ? "passes"
                  : progress.stage == SolveProgress::Stage::scaling_lobes ? "scaling lobes"
                                                                          : "reflecting";
  dict["stage_share"] = progress.stage_fraction;
  return dict;
}

py::dict to_dict(const SolveStatistics& s) {
  py::dict dict;
  dict["patches"] = s.patches;
  dict["fragments"] = s.fragments;
  dict["directions"] = s.directions;
  dict["passes"] = s.passes;
  dict["passes_made"] = s.passes_made;
  dict["iterations"] = s.iterations;
  dict["converged"] = s.converged;
  dict["threads"] = s.threads;
  dict["transfers"] = s.transfers;
  dict["integrated_pairs"] = s.integrated_pairs;
  dict["form_factors"] = s.form_factors;
  dict["closure_defect"] = s.closure_defect_max;
  dict["closure_defect_moments"] = s.closure_defect_moments;
  dict["negative_corners"] = s.negative_corners;
  dict["escaped"] = s.escaped;
  dict["energy_defect"] = s.energy_defect;
  dict["energy_balance"] = s.energy_balance;
  dict["rho_max"] = s.rho_max;
  dict["shot_sources"] = s.shot_sources;
  dict["shot_disagreement"] = s.shot_disagreement;
  dict["light_directions"] = s.light_directions;
  dict["seconds"] = s.seconds_total;
  return dict;
}

/// The progress of a solver, from the thread that solves to Python's.
class ProgressRelay {
 public:
  explicit ProgressRelay(py::object callback) : callback_(std::move(callback)) {}
  /// On the thread that solves.
  void put(const SolveProgress& progress) {
    if (!callback_.is_none()) {
      const std::lock_guard lock(mutex_);
      newest_ = progress;
    }
  }
  /// On Python's thread.
  void tell() {
    std::optional<SolveProgress> progress;
    {
      const std::lock_guard lock(mutex_);
      std::swap(progress, newest_);
    }
    if (progress) {
      callback_(to_dict(*progress));
    }
  }

 private:
  py::object callback_;
  std::mutex mutex_;
  std::optional<SolveProgress> newest_;
};

Solution solve_scene(const ScenePtr& scene, const py::dict& keywords, const py::object& progress) {
  const SolveOptions options = options_from(keywords);
  if (const std::string why = options.why_dark(scene->has_light()); !why.empty()) {
    throw InputError(scene->name() + ": " + why);
  }
  ProgressRelay relay(progress);
  return run_cancelably(
      [&](const Cancellation& cancellation) {
        if (!takes_directions(options.engine)) {
          return solve_by_form_factors(scene, options, cancellation);
        }
        return solve(
            scene, options,
            [&](const SolveSession& session) {
              relay.put(session.progress());
              return true;
            },
            cancellation);
      },
      [&] { relay.tell(); });
}

py::tuple to_arrays(const FormFactors& f) {
  py::array_t<std::int64_t> begin(static_cast<py::ssize_t>(f.row_begin.size()));
  std::copy(f.row_begin.begin(), f.row_begin.end(), begin.mutable_data());
  return py::make_tuple(to_array(f.value), to_array(f.source), begin);
}

py::tuple form_factors(const ScenePtr& scene, const py::dict& keywords,
                       const py::object& progress) {
  refuse(keywords, {"accuracy",
                    "accuracy_of",
                    "seconds",
                    "iterations",
                    "tolerance",
                    "scheme",
                    "burn_in",
                    "first_shot",
                    "basis",
                    "glossy",
                    "sky",
                    "sky_model",
                    "up",
                    "sun",
                    "site",
                    "time",
                    "north",
                    "sun_direction",
                    "sun_irradiance",
                    "sun_disc"},
         true, "form_factors()");
  SolveOptions options = options_from(keywords, Goal::none);
  options.first_shot.reset();
  ProgressRelay relay(progress);
  const FormFactors result = run_cancelably(
      [&](const Cancellation& cancellation) -> FormFactors {
        options.iterations = 1;
        if (!takes_directions(options.engine)) {
          return *solve_by_form_factors(scene, options, cancellation).form_factors;
        }
        RadiositySolver solver(scene, options, {}, cancellation);
        solver.keep_form_factors();
        solver.advance(RadiositySolver::Until::iteration, [&](const RadiositySolver& s) {
          relay.put(s.progress());
          return true;
        });
        return solver.form_factors();
      },
      [&] { relay.tell(); });
  return to_arrays(result);
}

SolveSession::Until until_from(const std::string& name) {
  if (name == "direction") {
    return SolveSession::Until::direction;
  }
  if (name == "iteration") {
    return SolveSession::Until::iteration;
  }
  if (name == "finished") {
    return SolveSession::Until::finished;
  }
  throw InputError("until: \"" + name + "\" is neither direction, iteration nor finished");
}

/// A solve that is advanced pass by pass. Ctrl-C pauses it after the pass under way.
class Run {
 public:
  Run(const ScenePtr& scene, const py::dict& keywords) {
    const SolveOptions options = options_from(keywords);
    if (!takes_directions(options.engine)) {
      throw InputError("Run: engine " + name_of(options.engine) + " has no directions");
    }
    session_ = run_interruptibly(
        [&] {
          auto session = std::make_unique<SolveSession>(
              SolveRequest{.scene = scene, .options = options}, cancellation_);
          session->prepare();
          return session;
        },
        [] {}, [&] { cancellation_.cancel(); });
  }

  bool advance(const std::string& until, const py::object& progress) {
    const SolveSession::Until where = until_from(until);
    const Use use(busy_);
    std::atomic<bool> going = true;
    ProgressRelay relay(progress);
    return run_interruptibly(
        [&] {
          const bool unfinished = session_->advance(where, [&](const SolveSession& session) {
            relay.put(session.progress());
            return going.load();
          });
          if (unfinished) {
            session_->prepare();  // the next stage of an accuracy, for those who read it
          }
          return unfinished;
        },
        [&] { relay.tell(); }, [&] { going = false; });
  }

  /// Returns `get` of the solver, found without Python's lock.
  template <class Get>
  auto read(Get get) {
    const Use use(busy_);
    const py::gil_scoped_release released;
    return get(*session_);
  }

 private:
  /// One use at a time: the solver is not to be read while it works, nor from `progress`.
  class Use {
   public:
    explicit Use(std::atomic<bool>& busy) : busy_(busy) {
      if (busy_.exchange(true)) {
        throw std::runtime_error("the run is being advanced or read");
      }
    }
    ~Use() { busy_ = false; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    std::atomic<bool>& busy_;
  };

  std::atomic<bool> busy_ = false;
  Cancellation cancellation_;
  std::unique_ptr<SolveSession> session_;
};

/// B at the corners of all outlines, one outline after the other.
py::array_t<double> corners_of(const Solution& solution) {
  std::vector<Rgb> all;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const std::vector<Rgb> of_patch = corner_radiosity(solution, i);
    all.insert(all.end(), of_patch.begin(), of_patch.end());
  }
  return to_table<3>(all);
}

py::object standard_error_of(const ErrorEstimate& error) {
  return error.replicas > 0 ? py::object(to_table<3>(error.standard_error)) : py::none();
}

/// The picture as an array (height, width, 3).
py::array_t<float> picture(const Solution& solution, const py::handle& eye,
                           const py::handle& target, const py::handle& up,
                           const std::optional<double>& field_of_view,
                           const std::array<int, 2>& size, int samples, int gather) {
  Camera camera{to_vec3(eye, "eye"), solution.scene->bounds().center(), to_vec3(up, "up")};
  if (!target.is_none()) {
    camera.target = to_vec3(target, "target");
  }
  camera.field_of_view = field_of_view;
  PictureOptions options;
  options.width = size[0];
  options.height = size[1];
  options.samples = samples;
  options.gather = gather;
  const Picture made = run_cancelably([&](const Cancellation& cancellation) {
    return make_picture(std::make_shared<const Solution>(solution), camera, options, cancellation);
  });
  py::array_t<float> array({size[1], size[0], 3});
  float* next = array.mutable_data();
  for (const Rgb& radiance : made.radiance) {
    for (const double channel : {radiance.r, radiance.g, radiance.b}) {
      *next++ = static_cast<float>(channel);
    }
  }
  return array;
}

std::optional<py::dict> surface_errors_of(const Solution& solution) {
  if (solution.error.replicas == 0) {
    return {};
  }
  py::dict errors;
  for (const SurfaceError& surface : solution.error.surfaces.surfaces) {
    errors[py::str(surface.name)] = surface.limit;
  }
  return errors;
}

std::optional<py::dict> accuracy_of(const Solution& solution) {
  if (!solution.accuracy) {
    return {};
  }
  const AccuracyReport& report = *solution.accuracy;
  py::dict dict;
  dict["reached"] = report.reached;
  dict["error"] = report.error;
  dict["surface"] = report.surface;
  dict["obstacle"] = report.obstacle == AccuracyObstacle::none
                         ? py::object(py::none())
                         : py::object(py::str(name_of(report.obstacle)));
  dict["passes"] = report.passes_made;
  return dict;
}

void bind_solution(py::module_& module) {
  py::class_<Solution>(module, "Solution")
      .def_property_readonly(
          "scene", [](const Solution& s) { return std::const_pointer_cast<Scene>(s.scene); })
      .def_property_readonly("radiosity",
                             [](const Solution& s) { return to_table<3>(s.radiosity); })
      .def_property_readonly("corner_radiosity", &corners_of)
      .def_property_readonly("irradiance",
                             [](const Solution& s) { return to_table<3>(s.irradiance); })
      .def_property_readonly("standard_error",
                             [](const Solution& s) { return standard_error_of(s.error); })
      .def_property_readonly("quantile", [](const Solution& s) { return s.error.quantile; })
      .def_property_readonly("rms_error",
                             [](const Solution& s) -> std::optional<double> {
                               if (s.error.replicas == 0) {
                                 return {};
                               }
                               return s.error.rms_limit;
                             })
      .def_property_readonly("surface_errors", &surface_errors_of)
      .def_property_readonly("accuracy", &accuracy_of)
      .def_property_readonly("complete", [](const Solution& s) { return s.complete; })
      .def_property_readonly("statistics", [](const Solution& s) {
        py::dict dict = to_dict(s.statistics);
        dict["uncertain_patches"] = uncertain_patches(s).size();
        return dict;
      });
}

void bind_run(py::module_& module) {
  py::class_<Run>(module, "Run")
      .def(py::init<const ScenePtr&, const py::dict&>())
      .def("advance", &Run::advance)
      .def_property_readonly(
          "progress",
          [](Run& run) {
            return to_dict(run.read([](const SolveSession& s) { return s.progress(); }));
          })
      .def_property_readonly("radiosity",
                             [](Run& run) {
                               return to_table<3>(run.read(
                                   [](const SolveSession& s) { return s.running_estimate(); }));
                             })
      .def_property_readonly("directions",
                             [](Run& run) {
                               return to_table<3>(run.read([](const SolveSession& s) {
                                 return std::vector<Vec3>(s.directions());
                               }));
                             })
      .def("solution",
           [](Run& run) { return run.read([](const SolveSession& s) { return s.solution(); }); })
      .def("form_factors", [](Run& run) {
        return to_arrays(run.read([](const SolveSession& s) {
          if (s.diffuse() == nullptr) {
            throw InputError("form factors are not available where lobes take part (glossy)");
          }
          return s.diffuse()->form_factors();
        }));
      });
}

}  // namespace

void bind_solve(py::module_& module) {
  bind_solution(module);
  bind_run(module);
  module.def("solve", &solve_scene);
  module.def("form_factors", &form_factors);
  module.def("picture", &picture);
}

}  // namespace transillum::python
