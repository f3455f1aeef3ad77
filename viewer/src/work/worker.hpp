#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace halfspace::viewer {

/// A thread that carries out jobs, one after another.
///
/// It is to be the last member of its owner: its destructor waits for the job
/// that is carried out, which uses the others.
template <class Job>
class Worker {
 public:
  explicit Worker(std::function<void(const Job&)> carry_out)
      : carry_out_(std::move(carry_out)), thread_([this] { work(); }) {}

  /// Begins no other job, and waits for the one that is carried out.
  ~Worker() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Carries out the job after all that wait. Does not wait itself.
  void add(Job job) {
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(std::move(job));
    }
    changed_.notify_all();
  }

  /// Carries out the job in place of all that wait.
  void replace(Job job) {
    {
      const std::lock_guard lock(mutex_);
      waiting_.clear();
      waiting_.push_back(std::move(job));
    }
    changed_.notify_all();
  }

  /// Whether the job that is carried out is to end, as its owner does.
  bool is_ending() const {
    const std::lock_guard lock(mutex_);
    return ends_;
  }

 private:
  void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
      if (ends_) return;
      const Job job = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      carry_out_(job);
    }
  }

  std::function<void(const Job&)> carry_out_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace halfspace::viewer
