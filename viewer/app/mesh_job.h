// Meshes that are made while the window goes on.
#pragma once
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "viewer/render/mesh_view.h"
#include "viewer/render/scene_file.h"

namespace sdf::viewer {

/// A MeshOrder says of which scene, at which moment, which mesh is wanted.
struct MeshOrder {
  SceneFile file;
  int edition = 0;  ///< of the file: another number is another text
  Values values{};
  double time = 0.0;
  MeshRequest request;
  bool operator==(const MeshOrder&) const = default;
};

/// A MeshJob makes what was ordered last, on a thread of its own. Its functions do not wait for that.
class MeshJob {
 public:
  using Made = Result<std::shared_ptr<const MeshView>>;

  MeshJob();
  MeshJob(const MeshJob&) = delete;
  MeshJob& operator=(const MeshJob&) = delete;
  /// Gives up what is being made, and waits until the thread has ended.
  ~MeshJob();

  /// Begins with this in the place of what is being made, unless it is what was ordered last.
  void order(const MeshOrder& order);
  /// Gives up what is being made.
  void cancel();
  /// Begins once more with what was ordered last.
  void again();

  /// Returns what became of the last order, once.
  std::optional<Made> take();
  /// Whether something is being made, or is about to be.
  bool working() const;
  /// Says at what stage it is, and what share of that is done: "sampling, 40 %".
  std::string stage() const;

 private:
  /// Tells other threads how far the work is.
  class Stage : public Progress {
   public:
    void beginStage(std::string_view name) override;
    void update(double fraction) override { share_.store(fraction, std::memory_order_relaxed); }
    std::string text() const;

   private:
    mutable std::mutex mutex_;
    std::string name_ = "script";
    std::atomic<double> share_{0.0};
  };
  void begin();  // with the lock held
  void run();
  Made make(const MeshOrder& order, Progress& progress);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<MeshOrder> last_;
  std::shared_ptr<Stage> wanted_;  // of the last order, until it is done or given up
  bool begun_ = false, ends_ = false;
  std::optional<Made> made_;
  // The thread's own: the scene's mesh that was made last, and by which order.
  std::shared_ptr<const SceneMesh> known_;
  std::optional<MeshOrder> knownBy_;
  std::thread thread_;  // last: it uses all of these
};

}  // namespace sdf::viewer
