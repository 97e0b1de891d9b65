// What the window shows, without the window: the scene, what the user has changed, and the shaders for it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "viewer/app/mesh_job.h"
#include "viewer/render/picture_options.h"
#include "viewer/render/present_scene.h"
#include "viewer/render/renderer.h"
#include "viewer/render/scene_file.h"

namespace sdf::viewer {

/// A Watch looks at one file by its time of writing and its size. Meshes that a scene names are not watched:
/// they are read anew when the scene is, if they have changed.
class Watch {
 public:
  explicit Watch(std::filesystem::path file);

  /// Whether the file has been written since this was last asked, or since the beginning. A file that is
  /// missing, as while an editor replaces it, counts once it is back.
  bool written();

 private:
  using Stamp = std::pair<std::filesystem::file_time_type, std::uintmax_t>;
  std::optional<Stamp> stamp() const;

  std::filesystem::path file_;
  std::optional<Stamp> last_;
};

/// LookEdits are changes of the look; what is not here is as in the scene.
struct LookEdits {
  std::map<std::size_t, LookLight> lights;  ///< by index
  std::optional<glm::vec3> ambient, fogColor;
  std::optional<float> fogDensity;
  bool operator==(const LookEdits&) const = default;
};

/// Controls are all that the user can change. Equal controls of the same scene give the same picture.
struct Controls : PictureOptions {
  Values materials{};                       ///< surface parameters that were moved, by name
  std::set<std::string> editedMaterials{};  ///< parts whose surface parameters can be moved
  LookEdits look{};
  bool operator==(const Controls&) const = default;
};

/// Requests are what keys and panels ask the window to do at its next turn.
struct Requests {
  bool fit = false;          ///< all of the scene in view
  bool savePicture = false;  ///< as the file that the panel names
  bool copyCamera = false;   ///< as scene text, to the clipboard
  bool measure = false;      ///< readings a pixel
  bool exportMesh = false;   ///< as the file that the panel names
  bool close = false;
};

/// A Session works in the context that is current, which must be the same for its whole life.
class Session {
 public:
  /// Loads the scene and compiles its shaders. Errors: those of loadScene and of Renderer::make.
  static Result<Session> open(const SceneFile& file, Controls controls = {});

  /// The controls are for everyone to change; settle() then makes the picture fit them.
  Controls controls;
  bool playing = false;
  /// The width of the picture by its height, to which cameras are fitted.
  double aspect = kPictureAspect;

  /// Lets the clock run, if it is playing.
  void advance(double seconds) {
    if (playing) controls.time += seconds;
  }

  /// Moves the camera along its direction to where all of the scene, as it is now, is in view. Errors: Scene,
  /// where the scene is unbounded or its file has become wrong; the camera stays then.
  Status fit();

  /// Makes the renderer fit the controls, and hands it the mesh that was made meanwhile; until a view of one
  /// has its mesh the picture is shown. Another mesh is ordered where what it follows from has changed; while
  /// the clock runs, once the last one is done. Only another view, method or set of materials to edit
  /// compiles; if that fails, they go back to what is shown, and message() says why. Where a parameter moved
  /// whose value the script had read (Scene::valuesRead), the script runs again; edits of the look and of
  /// materials stay.
  void settle();

  /// Loads the scene again if its file was written, or one that it reads: parameters that are still there
  /// keep their values, the camera and the clock stay, edits of the look and of materials give way to what
  /// the file says. On an error the scene stays, and message() says what is wrong, and in which line.
  void followFile();
  /// Loads the scene again like followFile, whether its file was written or not.
  void reload();
  /// Gives all parameters the values that the file has.
  void resetParameters();

  /// Returns the mesh that is shown or was last, if there is one.
  const MeshView* mesh() const { return mesh_.get(); }
  /// Returns the figures of the errors that are shown, if they are.
  const ErrorFigures* errors() const;
  /// Counts the meshes that were handed over: a picture drawn at another count is of another one.
  int meshes() const { return meshes_; }
  /// Whether a mesh is being made, and at what stage that is.
  bool meshing() const { return job_ && job_->working(); }
  std::string meshStage() const { return job_ ? job_->stage() : ""; }
  /// Gives up the mesh that is being made; the one that is shown stays. meshAgain begins once more.
  void cancelMesh();
  void meshAgain();
  /// Returns the size of the scene that sliders of lengths go by, scene units.
  double extent() const;
  /// Writes the mesh that is shown, as sdf2gltf does. Errors: Limits where there is none of the scene's own;
  /// those of writeMeshes.
  Status exportMesh(const std::filesystem::path& target) const;

  const Scene& scene() const { return scene_; }
  /// Says what is wrong with the file, or else with what the controls last asked for, or else what is missing
  /// of the scene; "" if all is well.
  const std::string& message() const {
    for (const std::string* one : {&fileMessage_, &buildMessage_, &meshMessage_})
      if (!one->empty()) return *one;
    return missingMessage_;
  }
  Renderer& renderer() { return renderer_; }
  const Renderer& renderer() const { return renderer_; }
  /// Counts how often shaders were compiled: a picture drawn at another count is of another scene.
  int compilations() const { return compilations_; }

  bool hasClock() const;
  double value(const ParameterInfo& parameter) const;  ///< also of surface parameters
  Look look() const;
  Eye eye() const { return look().eye; }
  Frame frame() const { return controls.frame(values(), look()); }

  /// Measures the readings of the present picture at this size, for which it compiles shaders that count.
  /// Errors: Limits, Graphics.
  Result<Readings> measure(int width, int height) const;

 private:
  /// What the renderer was made for.
  struct Built {
    ShaderOptions shader;
    std::set<std::string> materials;
    bool operator==(const Built&) const = default;
  };
  /// A scene for all values of its inputs, and as it is for the present ones, with its renderer.
  struct Loaded {
    Scene scene;
    PresentScene present;
    Scene now;
    LookFunction look;
    Renderer renderer;
  };
  Session(SceneFile file, Controls start, Loaded loaded, Built built);
  static Result<Renderer> build(const Scene& now, const PresentScene& present, const Built& wanted);
  Result<Renderer> build(const Built& wanted) const { return build(now_, present_, wanted); }
  static Result<Loaded> loaded(const SceneFile& file, Scene scene, LookFunction look,
                               const Values& parameters, double time, const Built& wanted);
  /// Replaces scene and renderer by what the file says for the controls' values. On an error both stay.
  Status load(const Built& wanted);
  /// Loads the scene with these materials to edit and keeps the message; whether it could.
  bool run(const std::set<std::string>& editedMaterials);
  Built wanted() const { return wanted(controls.editedMaterials); }
  Built wanted(const std::set<std::string>& materials) const;
  /// Draws the scene with the slopes of the present values, if they hang on those that have moved.
  void followValues();
  /// Orders the mesh that is wanted, and takes the one that is done.
  void followMesh();
  /// Hands the renderer the mesh that its view shows.
  Status showMesh(Renderer& renderer) const;
  MeshOrder meshOrder() const;
  Values values() const;
  /// Watches what the scene has read; what it read before counts as read then.
  void watchFiles();
  /// Says what the scene is made without.
  void tellMissing();
  /// The present values of what the script has read.
  Values read() const;

  SceneFile file_;
  Watch watch_;
  std::map<std::string, Watch> watched_;  ///< the files that its script has read
  Scene scene_;
  PresentScene present_;
  Scene now_;  // as it is drawn
  LookFunction look_;
  Renderer renderer_;
  Built built_;
  Values ran_;  ///< what read() was when the script was last run
  std::string fileMessage_, buildMessage_, meshMessage_, missingMessage_;
  int compilations_ = 1, meshes_ = 0, edition_ = 0;  // the last: of the file
  std::shared_ptr<const MeshView> mesh_;
  std::unique_ptr<MeshJob> job_;  // from the first mesh on
};

}  // namespace sdf::viewer
