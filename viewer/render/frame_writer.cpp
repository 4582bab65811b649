#include "viewer/render/frame_writer.h"

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <tuple>

#include "engine/base/hash.h"

namespace aerascope {

class FrameWriter::Queue {
 public:
  Queue(Encoder encoder, Sink sink)
      : encoder_(std::move(encoder)), sink_(std::move(sink)), thread_([this] { Work(); }) {}

  ~Queue() {
    {
      const std::lock_guard lock(mutex_);
      waiting_.clear();
    }
    Close();
  }

  std::size_t Add(Image image) {
    const Key key{image.size.width, image.size.height,
                  HashOf({reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size()})};
    const auto [known, is_new] = number_of_.try_emplace(key, number_of_.size());
    if (is_new) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting; });
      waiting_.push_back(std::move(image));
      changed_.notify_all();
    }
    return known->second;
  }

  Status Finish() {
    Close();
    if (failure_) return *failure_;
    return Ok();
  }

 private:
  using Key = std::tuple<int, int, Hash128>;
  static constexpr std::size_t kMostWaiting = 4;

  void Close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

  std::optional<Image> Take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    Image image = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    return image;
  }

  void Work() {
    std::size_t number = 0;
    while (const std::optional<Image> image = Take()) {
      if (!failure_) Encode(*image, number);
      ++number;
    }
  }

  void Encode(const Image& image, std::size_t number) {
    Result<std::string> bytes = encoder_(image);
    const Status status = bytes ? sink_(number, std::move(*bytes)) : Status(bytes.error());
    if (!status) failure_ = status.error();
  }

  Encoder encoder_;
  Sink sink_;
  std::map<Key, std::size_t> number_of_;  // of the adding thread
  std::optional<Error> failure_;          // of the writer's thread until that has ended

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Image> waiting_;
  bool closed_ = false;
  std::thread thread_;
};

FrameWriter::FrameWriter(Encoder encoder, Sink sink)
    : queue_(std::make_unique<Queue>(std::move(encoder), std::move(sink))) {}
FrameWriter::~FrameWriter() = default;

std::size_t FrameWriter::Add(Image image) {
  return queue_->Add(std::move(image));
}
Status FrameWriter::Finish() {
  return queue_->Finish();
}

}  // namespace aerascope
