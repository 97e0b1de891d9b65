// Scene: shapes with names, and all that is needed to look at them.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/base/result.h"
#include "sdf/expr/vec.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// A camera. Vectors and numbers may depend on parameters and time, not on position.
struct Camera {
  /// None: the camera is fitted (scene/fit.h): it looks at the middle of the scene along the way from
  /// eye() to `to`, from where all of the scene is in view.
  std::optional<Vec3E> from{};
  Vec3E to{Expr(0.0)};
  Vec3E up{Expr(0.0), Expr(1.0), Expr(0.0)};
  Expr fov = 45.0;  ///< vertical field of view, degrees
  /// Flips left and right, for scenes ported from shaders that build right = up x forward.
  bool mirrored = false;
  Expr aperture = 0.0;  ///< radius of its thin lens, scene units; 0: a pinhole, which sees all sharply
  /// How far along the way that it looks is seen sharply by a lens, scene units; none: as far as `to`.
  std::optional<Expr> focus{};

  /// `from`, or {3.4, 2.6, 4.6} where there is none.
  Vec3E eye() const { return from.value_or(Vec3E(Expr(3.4), Expr(2.6), Expr(4.6))); }
};

struct Light {
  enum class Kind {
    Directional,  ///< far away: its light has one direction
    Point         ///< at a place
  };
  Kind kind = Kind::Directional;
  Vec3E vector{Expr(1.0)};  ///< Directional: towards the light, any length. Point: its position
  Vec3E color{Expr(1.0)};   ///< linear RGB
  Expr intensity = 1.0;     ///< no fall-off with distance (the seeds' and Phong's convention)
  bool castsShadow = true;
  /// Its size. Point: the radius of a ball, scene units. Directional: half the angle that it is seen under,
  /// degrees below 90. Above 0 its shadows are those of all its points, whatever the shadows' kind.
  /// Unshadowed light, highlights included, stays that of its middle.
  Expr radius = 0.0;
};

struct Shadow {
  /// All but None are a ShadowMethod (march/shadow.h).
  enum class Kind {
    None,      ///< lights reach everything
    Hard,      ///< a ray that hits takes all light
    Soft,      ///< by the least distance over way (Quilez 2010)
    Improved,  ///< the same, estimated between the readings (Aaltonen 2018)
    Signed     ///< the same through the solid, so that half the light is at its edge
  };
  Kind kind = Kind::None;
  Expr sharpness = 8.0;           ///< k of k d / t; larger is harder
  std::optional<double> start{};  ///< where the shadow ray leaves the surface; none: see viewLengths
  std::optional<double> reach{};  ///< how far it goes; none: see viewLengths
  int steps = 500;  ///< readings that a ray may take; one that runs out of them is taken for dark
};

struct AmbientOcclusion {
  enum class Kind {
    None,  ///< all ambient light arrives
    Taps,  ///< by distances along the normal
    Steps  ///< by the steps that the ray took
  };
  Kind kind = Kind::None;
  std::optional<double> spacing{};  ///< Taps: between samples along the normal; none: see viewLengths
  int count = 5;                    ///< Taps: how many
  Expr strength = 0.2;              ///< Taps: weight of each; Steps: darkening of each marching step
};

struct Fog {
  Vec3E color{Expr(0.0)};
  Expr density = 0.0;  ///< share kept is exp(-density * distance)
};

struct Part {
  std::string name;
  Shape shape;
};

/// How a picture's light becomes colours that can be shown, each of red, green and blue by itself.
enum class Tone {
  Linear,  ///< as it is, cut off at 1
  /// c (2.51 c + 0.03) / (c (2.43 c + 0.59) + 0.14), at most 1. It keeps differences far above 1 and darkens
  /// shadows (Narkowicz, "ACES filmic tone mapping curve", 2015, without a factor before).
  Filmic
};

/// The colour seen along a ray that hits nothing is an expression of the ray's unit direction, held in x, y
/// and z.
struct Scene {
  std::vector<Part> parts;  ///< united; a later part wins a tie. Names are unique
  std::vector<ParameterInfo> parameters;
  /// Names of those parameters whose values shaped the scene while it was made (`value` in scene files): for
  /// another value of one the scene must be made again.
  std::set<std::string> valuesRead;
  std::optional<Box> bounds;  ///< an unbounded scene is clipped to it when it is meshed
  Camera camera;
  std::vector<Light> lights;
  Vec3E ambient{Expr(0.1)};
  Vec3E background{Expr(0.05), Expr(0.05), Expr(0.08)};
  Expr backgroundLight = 0.0;  ///< share of the background that lights surfaces (scene/background_light.h)
  Fog fog;
  Shadow shadow;
  AmbientOcclusion ambientOcclusion;
  int reflectionBounces = 1;
  bool glossyReflections = false;       ///< mirrored rays are spread over the lobe of Phong's highlight
  std::optional<double> maxDistance{};  ///< how far the camera sees; none: see viewLengths
  Tone tone = Tone::Linear;
  std::optional<double> gamma;       ///< none: sRGB output; 1: raw values. After the tone
  std::vector<std::string> notes;    ///< warnings for its author, a line each
  std::vector<std::string> missing;  ///< why meshes that it names are not in it, a line each
  std::vector<std::string> files;    ///< read by its script beside its own, by their whole paths

  /// Adds a part under a name of its own ("" takes "part N").
  void add(std::string name, Shape shape);
  /// A number that the user may change, for use in the scene's formulas. Each name once.
  Expr parameter(std::string name, double value, double min = 0.0, double max = 1.0);
  /// All parts united, for the viewer and for readings that want one distance.
  Shape whole() const;
};

/// The lights of a scene that names none: a key light from above, to the left of the camera's usual place,
/// and a weak one from the right that casts no shadow. They light each side of a box along the axes
/// differently.
std::vector<Light> standardLights();
/// The shadow that they cast where the scene says nothing of shadows: a soft one.
Shadow standardShadow();
/// The background of a scene that names no lights: grey, darker upwards.
Vec3E standardBackground();

/// The scene if it can be used: at least one part, no failed shape, unique names. Otherwise what is wrong.
Result<Scene> checked(Scene scene);

}  // namespace sdf
