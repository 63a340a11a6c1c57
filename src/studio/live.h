// Looks that follow a hand: answered at once, never steps. Layer: studio.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "rholm/smooth.h"
#include "rholm/transfer.h"
#include "studio/items/message.h"
#include "studio/step.h"

namespace rholm::studio {

// Of one session. For several threads: of each kind one request is worked on at a time, and of
// those that wait only the newest is.
class Live {
 public:
  explicit Live(int threads) : threads_(threads) {}
  // Throws Refusal 409 "superseded" for a request that a newer one has overtaken.
  Response answer(const Json& request, const Document& document);

 private:
  struct Kind {
    std::mutex working;
    std::atomic<std::uint64_t> newest{0};
  };
  // An analysis, and what it is of; only the last one is kept.
  template <typename T>
  struct Kept {
    std::string key;
    std::shared_ptr<const void> of[2];  // the meshes: as long as they live no other has their place
    std::shared_ptr<const T> analysis;
  };

  Response degree(const Json& request, const Document& document) const;
  Response brush(const Json& request, const Document& document) const;
  Response smooth(const Json& request, const Document& document);
  Response transfer(const Json& request, const Document& document);
  Response blend(const Json& request, const Document& document) const;
  Context context() const { return {.threads = threads_}; }

  const int threads_;
  std::map<std::string, Kind> kinds_;
  std::mutex mutex_;  // of the map
  Kept<Patch> patch_;
  Kept<TransferSource> source_;  // the texture, while its target moves
  Kept<TransferAnalysis> transfer_;
  bool transfer_angle_ = false;  // whether it has looked for the angle
};

}  // namespace rholm::studio
