// Who works on tiles: this process, or several that share a store. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <functional>

namespace rholm {

// All processes of a crew go through the same stages in the same order. A body leaves what it finds
// in the store only, where all see it once the stage has ended.
class TileCrew {
 public:
  using Body = std::function<void(std::size_t tile)>;
  // How many tiles of the stage are done, by all.
  using Done = std::function<void(std::size_t tiles)>;

  TileCrew() = default;
  virtual ~TileCrew() = default;
  TileCrew(const TileCrew&) = delete;
  TileCrew& operator=(const TileCrew&) = delete;

  // Calls the body once for each of 0 ... n - 1, on one process or another.
  virtual void each(std::size_t n, const Body& body, const Done& done) = 0;
  // Calls the body on one of them.
  virtual void once(const std::function<void()>& body) = 0;
  // Whether there are others.
  virtual bool is_shared() const { return true; }
};

// This process alone: one tile after the other.
class OneProcess final : public TileCrew {
 public:
  void each(std::size_t n, const Body& body, const Done& done) override {
    for (std::size_t tile = 0; tile < n; ++tile) {
      body(tile);
      done(tile + 1);
    }
  }
  void once(const std::function<void()>& body) override { body(); }
  bool is_shared() const override { return false; }
};

}  // namespace rholm
