// A store in memory. Layer: parts, private.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "parts/store.h"

namespace rholm {

class MemoryStore final : public PieceStore {
 public:
  using PieceStore::write;

  bool in_memory() const override { return true; }
  bool has(const std::string& name) const override;
  void write(const std::string& name, std::vector<SectionBytes> sections) override;
  PieceReader open(const std::string& name) const override;
  void remove(const std::string& name) override;
  std::unique_ptr<GrowingPieces> grow(const std::string& group, std::size_t n) override;
  void check_room(std::uint64_t) const override {}
  void keep(bool) override {}
  bool is_kept() const override { return false; }

 private:
  class Content;
  class Growing;

  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const Content>> pieces_;
};

}  // namespace rholm
