#include "parts/memory_store.h"

#include <algorithm>
#include <utility>

#include "rholm/error.h"

namespace rholm {
namespace {

// Returns the section itself if it has an owner, or a copy of the bytes that has one.
SectionBytes owned(const SectionBytes& section) {
  if (section.owner) return section;
  const auto copy =
      std::make_shared<const std::vector<std::byte>>(section.bytes.begin(), section.bytes.end());
  return {*copy, copy};
}

}  // namespace

class MemoryStore::Content final : public PieceContent {
 public:
  void add(const SectionBytes& section) {
    sections_.push_back(owned(section));
    bytes_ += section.bytes.size();
  }
  std::uint64_t bytes() const { return bytes_; }

  std::size_t n_sections() const override { return sections_.size(); }
  std::uint64_t size(std::size_t section) const override {
    return sections_.at(section).bytes.size();
  }
  const std::byte* place(std::size_t section) const override {
    return sections_.at(section).bytes.data();
  }
  void read(std::size_t section, std::span<std::byte> bytes) const override {
    std::ranges::copy(sections_.at(section).bytes, bytes.begin());
  }

 private:
  std::vector<SectionBytes> sections_;
  std::uint64_t bytes_ = 0;
};

class MemoryStore::Growing final : public GrowingPieces {
 public:
  Growing(MemoryStore& store, std::string group, std::size_t n)
      : store_(store), group_(std::move(group)), pieces_(n) {
    for (auto& piece : pieces_) piece = std::make_shared<Content>();
  }
  ~Growing() override { store_.bytes_.take(bytes_); }
  Growing(const Growing&) = delete;
  Growing& operator=(const Growing&) = delete;

  void append(std::size_t piece, std::span<const std::byte> section) override {
    pieces_[piece]->add({section});
    bytes_ += section.size();
    store_.bytes_.add(section.size());
  }

  void finish() override {
    std::uint64_t before = 0;
    {
      const std::lock_guard lock(store_.mutex_);
      std::erase_if(store_.pieces_, [&](const auto& piece) {
        const bool ours = piece.first.starts_with(group_ + "/");
        if (ours) before += piece.second->bytes();
        return ours;
      });
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        store_.pieces_[group_ + "/" + std::to_string(k)] = std::move(pieces_[k]);
      }
    }
    store_.bytes_.take(before);
    bytes_ = 0;
  }

 private:
  MemoryStore& store_;
  std::string group_;
  std::vector<std::shared_ptr<Content>> pieces_;
  std::uint64_t bytes_ = 0;  // of pieces that are not finished yet
};

bool MemoryStore::has(const std::string& name) const {
  check_piece_name(name);
  const std::lock_guard lock(mutex_);
  return pieces_.contains(name);
}

void MemoryStore::write(const std::string& name, std::vector<SectionBytes> sections) {
  check_piece_name(name);
  auto made = std::make_shared<Content>();
  for (const SectionBytes& section : sections) made->add(section);
  const std::uint64_t bytes = made->bytes();
  std::shared_ptr<const Content> piece = std::move(made);
  {
    const std::lock_guard lock(mutex_);
    pieces_[name].swap(piece);
  }
  bytes_.add(bytes);
  if (piece) bytes_.take(piece->bytes());
}

PieceReader MemoryStore::open(const std::string& name) const {
  check_piece_name(name);
  const std::lock_guard lock(mutex_);
  const auto found = pieces_.find(name);
  if (found != pieces_.end()) return PieceReader(found->second);
  throw Error(ErrorCode::kIo, "there is no piece " + name);
}

void MemoryStore::remove(const std::string& name) {
  check_piece_name(name);
  std::shared_ptr<const Content> gone;
  {
    const std::lock_guard lock(mutex_);
    const auto found = pieces_.find(name);
    if (found == pieces_.end()) return;
    gone = std::move(found->second);
    pieces_.erase(found);
  }
  bytes_.take(gone->bytes());
}

std::unique_ptr<GrowingPieces> MemoryStore::grow(const std::string& group, std::size_t n) {
  check_piece_name(group);
  return std::make_unique<Growing>(*this, group, n);
}

}  // namespace rholm
