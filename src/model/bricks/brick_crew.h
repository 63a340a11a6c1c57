// Who works on bricks: this process, or several that share a store. Layer: model, private.
#pragma once

#include <cstddef>
#include <functional>

namespace rholm {

// All processes of a crew go through the same stages in the same order. A body leaves what it finds
// in the store only, where all see it once the stage has ended.
class BrickCrew {
 public:
  using Body = std::function<void(std::size_t brick)>;
  // How many bricks of the stage are done, by all.
  using Done = std::function<void(std::size_t bricks)>;

  BrickCrew() = default;
  virtual ~BrickCrew() = default;
  BrickCrew(const BrickCrew&) = delete;
  BrickCrew& operator=(const BrickCrew&) = delete;

  // Calls the body once for each of 0 ... n - 1, on one process or another.
  virtual void each(std::size_t n, const Body& body, const Done& done) = 0;
  // Calls the body on one of them.
  virtual void once(const std::function<void()>& body) = 0;
  // Whether there are others.
  virtual bool is_shared() const { return true; }
};

// This process alone: one brick after the other.
class OneProcess final : public BrickCrew {
 public:
  void each(std::size_t n, const Body& body, const Done& done) override {
    for (std::size_t brick = 0; brick < n; ++brick) {
      body(brick);
      done(brick + 1);
    }
  }
  void once(const std::function<void()>& body) override { body(); }
  bool is_shared() const override { return false; }
};

}  // namespace rholm
