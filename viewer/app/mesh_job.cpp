#include "viewer/app/mesh_job.h"

#include <cmath>
#include <utility>

namespace sdf::viewer {
namespace {

// The same but for what is wanted of the mesh.
bool isOfOneMesh(MeshOrder a, const MeshOrder& b) {
  a.request.errors = b.request.errors;
  return a == b;
}

}  // namespace

void MeshJob::Stage::beginStage(std::string_view name) {
  const std::lock_guard lock(mutex_);
  name_ = name;
  share_ = 0.0;
}

std::string MeshJob::Stage::text() const {
  const std::lock_guard lock(mutex_);
  const double share = share_.load(std::memory_order_relaxed);
  return share > 0.0 ? name_ + ", " + std::to_string(std::lround(100.0 * share)) + " %" : name_;
}

MeshJob::MeshJob() : thread_([this] { run(); }) {}

MeshJob::~MeshJob() {
  cancel();
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void MeshJob::begin() {
  if (wanted_) wanted_->stop();
  wanted_ = std::make_shared<Stage>();
  begun_ = false;
  made_.reset();
  changed_.notify_one();
}

void MeshJob::order(const MeshOrder& order) {
  const std::lock_guard lock(mutex_);
  if (order == last_) return;
  last_ = order;
  begin();
}

void MeshJob::again() {
  const std::lock_guard lock(mutex_);
  if (last_) begin();
}

void MeshJob::cancel() {
  const std::lock_guard lock(mutex_);
  if (wanted_) wanted_->stop();
  wanted_.reset();
}

std::optional<MeshJob::Made> MeshJob::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(made_, std::nullopt);
}

bool MeshJob::working() const {
  const std::lock_guard lock(mutex_);
  return wanted_ != nullptr;
}

std::string MeshJob::stage() const {
  const std::lock_guard lock(mutex_);
  return wanted_ ? wanted_->text() : "";
}

void MeshJob::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ends_ || (wanted_ && !begun_); });
    if (ends_) return;
    begun_ = true;
    const std::shared_ptr<Stage> stage = wanted_;
    const MeshOrder order = *last_;
    lock.unlock();
    Made made = make(order, *stage);
    lock.lock();
    if (wanted_ != stage) continue;  // given up meanwhile
    made_ = std::move(made);
    wanted_.reset();
  }
}

MeshJob::Made MeshJob::make(const MeshOrder& order, Progress& progress) {
  auto scene = order.file.load({.values = order.values, .tolerant = true, .time = order.time, .fixed = true});
  if (!scene) return scene.error();
  const bool isKnown = !order.request.file && knownBy_ && isOfOneMesh(*knownBy_, order);
  auto view = makeMeshView(std::move(*scene), order.request, progress, isKnown ? known_ : nullptr);
  if (!view) return view.error();
  known_ = view->own;
  knownBy_ = order;
  return std::make_shared<const MeshView>(std::move(*view));
}

}  // namespace sdf::viewer
