// Previews during dragging: answered at once, never recorded as steps. Layer: studio.
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

// Previews of one session, for several threads. One request of each kind is
// processed at a time; of the waiting ones only the newest is processed.
class Live {
 public:
  explicit Live(int threads) : threads_(threads) {}
  // Throws Refusal 409 "superseded" if a newer request of the kind has arrived.
  Response answer(const Json& request, const Document& document);

 private:
  struct Kind {
    std::mutex working;
    std::atomic<std::uint64_t> newest{0};
  };
  // The last analysis, with its key and meshes.
  template <typename T>
  struct Kept {
    std::string key;
    std::shared_ptr<const void> of[2];  // the meshes, kept alive so their addresses stay unique
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
  std::mutex mutex_;  // guards the map
  Kept<Patch> patch_;
  Kept<TransferSource> source_;  // the texture, while its target moves
  Kept<TransferAnalysis> transfer_;
  bool transfer_angle_ = false;  // true if the analysis includes the angle
};

}  // namespace rholm::studio
