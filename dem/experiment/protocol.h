#pragma once

#include <optional>
#include <variant>

/// How each experiment is done, and what it gives.
namespace repose::dem {

/// Single grains dropped on a flat wall in random poses.
///
/// Value: how far the centroid rises from its lowest place during the bounce to the top of the
/// first flight after it, mm, mean of the grains; 0 for a grain that never leaves the wall. It is
/// what a camera sees. Readings: "above_first_touch_mm" (the same from the height of the centroid
/// at first touch: less, below 0 for a grain that topples), "lowest_point_rise_mm" (of the lowest
/// surface point over the wall at the top), "sd_mm" (scatter of the value between grains),
/// "never_rose" (how many), and with a lower height "low_rebound_mm" (the value from there, of the
/// same grains in the same poses).
struct DropProtocol {
  double height_m = .5;  ///< of the lowest point above the wall
  int grains = 10;       ///< in random poses, each on its own: one repeat is their mean
  /// A second drop, from below `height_m`: whether one restitution stands for both speeds.
  std::optional<double> low_height_m = {};
};

/// Grains bonded side by side, on a plate that tilts until they slide.
///
/// The grains touch, long axes parallel and level, shortest axes upright. The plate turns about
/// the direction of the long axes: down the slope lies the line from grain to grain, the one way in
/// which they can neither roll nor rock. A single grain rolls.
///
/// Value: the plate's angle at the onset of sliding, degrees. Slip grows as the cube of the time
/// since the onset; the line through its cube root is followed back to no slip. Readings:
/// "half_mm_slip_deg" (the plate's angle once the body has slipped half a millimetre; what others
/// report) and "begin_deg" (where the turning began). Throws NoMeasurement for a body that tips or
/// rolls, creeps from where the turning began, or holds up to 89 degrees. Restitution does not
/// matter: plates of more than .5 are taken to have .5, or bodies would rattle. There is no chance
/// in it: the seed changes nothing. Nor would chance be of use: as long as the body slides, its
/// angle is that of friction whatever its pose, and with the row across the slope ellipsoids roll
/// over their ends once tan(angle) = (a^2 - b^2) / 2ab (half-axes a > b: 14 degrees for a
/// hazelnut), before they slide. The scatter of a bench is that of its surfaces.
struct TiltProtocol {
  int bonded = 2;
  double rate_deg_s = 2;
  /// At least. The plate begins later, just short of where the body slides or tips, since a body
  /// that does not move has no history: Tilt.DoesNotDependOnWhereItBegins.
  double start_deg = 0;
};

/// One grain let go on an incline that ends on a flat plate.
///
/// It lies on the incline, its long axis across the slope but for a turn, and otherwise at random.
/// Value: how far along the flat its centroid lies from the foot once it is at rest, mm. A grain
/// that stays on the incline is released again, up to ten times, as at a bench; then it counts as
/// 0, which is also what the distance of a ball goes to as its rolling friction nears the slope
/// above which it stays. Readings: "lateral_mm" (aside), "stopped_on_incline" (0 or 1), "releases",
/// "hop_mm" (how high its lowest point rose above the flat), "time_s". Throws NoMeasurement for a
/// grain that does not stop.
struct RollProtocol {
  double incline_deg = 20;
  double release_m = .15;        ///< from the foot of the incline, along it
  double release_turn_deg = 10;  ///< of the long axis from lying across the slope, at most
};

/// A tube filled with grains and lifted off a plate.
///
/// The result is `Repeat::envelopes`, the heap's outline from all around: a line through them gives
/// its angle, and there is no value yet. Readings: "grains" (when the lift began),
/// "grains_on_plate", "grains_off_plate", "height_mm", "no_heap" (1: the grains spread in a layer
/// too low to be a heap, below 2.5 grain diameters), "at_rest" (0: still creeping 5 s after the
/// tube was away, as constant torques let heaps do), "time_s" (of lift and settling). Throws
/// NoMeasurement when the grains stay in the tube or leave the plate.
struct HeapProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .4;
  double tube_thickness_m = .002;
  double lift_speed_m_s = .03;
  double plate_m = .4;  ///< side of the square plate
  double plate_thickness_m = .002;
  std::optional<int> grains;  ///< or as many as fill the tube, levelled at its rim
  /// Of a level camera that takes pictures of the heap, from the tube's axis; none: from so far
  /// away that its rays are parallel. What is simulated takes no notice of it.
  std::optional<double> camera_distance_m = {};
  double camera_height_m = .04;  ///< of its lens, above the plate
  /// How many fit depends on their friction: where `grains` do not, take those that do. Without it
  /// they are refused.
  bool allow_partial_fill = false;
};

/// Grains bonded side by side, as in TiltProtocol, on a plate that is covered with glued grains of
/// the same kind (glued_bed.h): nothing but grains touch.
///
/// They are put down at random places of a random bed, fall into its hollows, and the plate turns
/// from level. Value: the plate's angle when they last stood still before they slid by a grain's
/// diameter, degrees, mean of the places: shifts within a hollow do not count. It has interlocking
/// in it, and is above the angle of friction. Readings: "first_shift_deg" (the angle at a shift of
/// a tenth of a diameter, their mean) and "sd_deg" (scatter of the value between places). Throws
/// NoMeasurement for grains that hold on up to 89 degrees.
struct GrainTiltProtocol {
  int bonded = 3;
  double rate_deg_s = 5;
  int places = 10;        ///< each with grains of its own: one repeat is their mean
  double coverage = .75;  ///< part of the plate that the glued grains hide
};

/// The same with single grains, which roll out of their hollows.
struct GrainRollProtocol {
  double rate_deg_s = 5;
  int places = 10;
  double coverage = .75;
};

/// Single grains dropped on such a plate, else as in DropProtocol: same value, same readings.
struct GrainDropProtocol {
  double height_m = .2;  ///< of the lowest point above the highest glued grain
  int grains = 20;       ///< in random poses over random places, each on its own
  double coverage = .75;
};

/// A tube filled by pouring and struck level at its rim; between the two it may be tapped.
///
/// The grains fall from a spout at `pour_m` above the rim, at random places over the tube and in
/// random poses, until they heap over the rim and rest. Those whose centres of mass lie above the
/// rim are struck off; all others stay whole. They come as fast as they fall, a layer upon the
/// other, which fills a tube of 150 mm in half a second, or at `pour_kg_s`, one by one: what
/// is poured slowly has time to settle, and comes to lie denser. Value: bulk density, kg/m^3: the
/// mass of those that stay by the tube's volume. Readings: "grains", "mass_g", "solid_fraction",
/// "filling_height_mm" (mean height of the upper surface of what stays, over the tube's whole
/// width).
///
/// To be tapped, the tube has a collar of a third of its height, as Carr (1965, Chemical
/// Engineering 72 (2), 163) has it: it is filled over the collar's rim, dropped `taps` times
/// by `tap_m` onto a base that does not give (tapping.h), and struck at its own rim. The value is
/// then the tapped bulk density, and "hausner_ratio" that by the one before the taps (Hausner 1967,
/// International Journal of Powder Metallurgy 3 (4), 7). Throws NoMeasurement when the grains sink
/// below the rim.
struct FillProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .1;
  double pour_m = .05;                   ///< from the spout to the rim, or to the collar's
  std::optional<double> pour_kg_s = {};  ///< none: as fast as grains fall
  std::optional<int> taps = {};          ///< none: it is not tapped
  double tap_m = .003;                   ///< the drop of ISO 3953
};
inline constexpr int kMaxTaps = 10'000;
/// Longer pours would be simulated for too long; up to here most has settled.
inline constexpr double kLongestPour_s = 60;

/// Two equal grains on strings, side by side: one is drawn aside, let go, and strikes the other.
///
/// The strings are as long as from the hinge to the grain's middle. Value: the angle to which the
/// struck grain swings, degrees, mean of the pairs, all of them grains in random poses that meet
/// with their middles at the same height. Between equal balls of restitution e its height is
/// ((1 + e) / 2)^2 of the other's. Readings: "rise_mm" (that height), "height_ratio" and "sd_deg"
/// (scatter of the value between pairs).
struct PendulumProtocol {
  double string_m = .3;
  double release_deg = 30;
  int pairs = 10;
};

/// Grains that run out of one box, through a slot in its floor, into another below it.
///
/// Both boxes are `length_m` long (x) and `depth_m` deep (y) inside, with upright walls; the slot
/// is in the middle and as deep as the boxes. The grains rain into the upper box and are struck
/// level: those whose centres of mass lie higher than the fill go. Then the slot opens at once.
/// Value: what has run out when all grains rest again, % of the fill. Readings: "filled_g",
/// "discharged_g", "time_s" (from the opening until 95 % of what runs out is below the slot: the
/// last grains trickle), "rate_g_s" (mean from 10 to 50 % of it, while the flow is steady),
/// "grains", "grains_out", "at_rest" (0: still creeping 5 s after the last grain ran out). The
/// angles of the two slopes that stay and of the heap below are measured in pictures of its state.
/// Throws NoMeasurement when no grains run out, when so many do that no slope stays (nothing, or a
/// single layer), when they arch over the slot, or when the lower heap reaches it.
struct DrawDownProtocol {
  double length_m = .5;
  double depth_m = .15;
  double slot_m = .12;
  double fill_m = .15;  ///< height of the grains in the upper box
  double drop_m = .25;  ///< from the slot's lower edge to the floor of the lower box
};

/// What the grains in the upper box lie on, m above the lower box's floor.
double upper_floor_m(const DrawDownProtocol& protocol);

/// Every experiment there is, in the order in which they are listed.
enum class Experiment {
  drop,
  tilt,
  roll,
  heap,
  drop_on_grains,
  tilt_on_grains,
  roll_on_grains,
  fill,
  pendulum,
  draw_down
};

/// How an experiment is done; its alternatives are in the order of Experiment.
using Protocol = std::variant<DropProtocol, TiltProtocol, RollProtocol, HeapProtocol,
                              GrainDropProtocol, GrainTiltProtocol, GrainRollProtocol, FillProtocol,
                              PendulumProtocol, DrawDownProtocol>;

}  // namespace repose::dem
