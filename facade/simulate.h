#pragma once

#include "base/input_error.h"
#include "calibrate/experiment/run_result.h"
#include "calibrate/run/simulate_study.h"
#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"
#include "dem/state/state_file.h"
#include "dem/study/grain_source.h"
#include "dem/study/study.h"
#include "render/renderer.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "vision/picture/picture.h"

/// Bench experiments simulated with grains and coefficients of a study file, and pictures of them.
/// Link repose::calibrate.
///
///     #include <iostream>
///     #include <repose/simulate.h>
///
///     int main(int, char* arguments[]) {
///       const repose::Study study = repose::read_study(arguments[1]);
///       const repose::SimulatedRun run = repose::simulate_study(study, "heap", 1, "heaps");
///       if (const auto angle_deg = repose::value_of(run.result)) {
///         std::cout << *angle_deg << " degrees\n";
///       } else {
///         std::cout << run.result.failure << '\n';
///       }
///       const repose::Scene scene = repose::scene_of(repose::read_state(run.state));
///       repose::Renderer renderer;
///       const auto drawn = renderer.draw(scene, repose::OrthographicCamera{}, {},
///                                        repose::PhotoStyle{});
///       repose::write_picture("heap.png", drawn.picture);
///     }
///
/// The same study and seed give the same numbers to the last bit, on any number of threads.
namespace repose {

using base::InputError;

// A study: grains, walls, coefficients, experiments. "key.path=value" settings replace values.
using dem::read_study;
using dem::Study;

// One run of one of its experiments, as all commands make it: a heap's angle is measured in its
// pictures.
using calibrate::readings_of;
using calibrate::RunResult;
using calibrate::simulate_study;
using calibrate::SimulatedRun;
using calibrate::value_of;

// The engine alone, step by step: grains, walls and contacts of your own.
using dem::build_grain;
using dem::ContactTable;
using dem::PairCoefficients;
using dem::RollingModel;
using dem::Simulation;
using dem::SimulationSetup;
using dem::sphere_shape;

// Pictures of a state.
using dem::read_state;
using dem::SavedState;
using render::OrthographicCamera;
using render::PhotoStyle;
using render::PictureSize;
using render::Renderer;
using render::Scene;
using render::scene_of;
using render::SilhouetteStyle;
using vision::Picture;
using vision::write_picture;

}  // namespace repose
