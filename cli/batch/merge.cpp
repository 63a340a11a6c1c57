#include "cli/batch/merge.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

struct Place {
  const BatchTable* part = nullptr;
  std::size_t row = 0;
};

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::kInvalidInput, what); }

// Returns the place of each row of the manifest in the parts.
std::vector<Place> places_of(const Manifest& manifest, const std::vector<BatchTable>& parts,
                             const std::vector<std::string>& names) {
  std::unordered_map<std::string, std::size_t> rows;
  for (std::size_t i = 0; i < manifest.items.size(); ++i) rows.emplace(manifest.items[i].id, i);
  std::vector<Place> places(manifest.items.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const BatchColumn* column = parts[p].find("id");
    const auto* ids =
        column == nullptr ? nullptr : std::get_if<std::vector<std::string>>(&column->values);
    if (ids == nullptr)
      refuse(fmt::format("{} has no column id and is not a part of a batch", names[p]));
    for (std::size_t r = 0; r < ids->size(); ++r) {
      const auto found = rows.find((*ids)[r]);
      if (found == rows.end()) {
        refuse(fmt::format("{}: the shape '{}' is not in the manifest", names[p], (*ids)[r]));
      }
      Place& place = places[found->second];
      if (place.part != nullptr) {
        refuse(fmt::format("{}: the shape '{}' is also in another part", names[p], (*ids)[r]));
      }
      place = {&parts[p], r};
    }
  }
  const auto missing = static_cast<std::size_t>(std::count_if(
      places.begin(), places.end(), [](const Place& place) { return place.part == nullptr; }));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].part != nullptr) continue;
    refuse(fmt::format("{} of {} shapes of the manifest are in no part; the first is '{}'", missing,
                       places.size(), manifest.items[i].id));
  }
  return places;
}

// Checks that all parts are of one job, and returns their common metadata without the shard.
std::vector<std::pair<std::string, std::string>> about_all(const std::vector<BatchTable>& parts,
                                                           const std::vector<std::string>& names) {
  const auto without_shard = [](const BatchTable& part) {
    auto about = part.about;
    std::erase_if(about, [](const auto& one) { return one.first == "shard"; });
    return about;
  };
  for (std::size_t p = 1; p < parts.size(); ++p) {
    if (without_shard(parts[p]) != without_shard(parts[0])) {
      refuse(
          fmt::format("{} and {} are parts of different jobs: their manifest, command, options or "
                      "version differ",
                      names[0], names[p]));
    }
  }
  return without_shard(parts[0]);
}

}  // namespace

BatchTable merge_parts(const BatchOptions& options) {
  if (options.words.empty())
    throw UsageError("--merge needs the results of the shards, for example part-1.h5 part-2.h5");
  check_results_name(options.output);
  for (const std::string& name : options.words) {
    if (extension_of(name) != extension_of(options.output)) {
      throw UsageError(fmt::format(
          "'{}' and '{}' have different formats; merge parts into a file of their own format", name,
          options.output));
    }
  }
  const Manifest manifest = read_manifest(options.manifest);
  std::vector<BatchTable> parts;
  parts.reserve(options.words.size());
  for (const std::string& name : options.words) parts.push_back(read_batch(name));
  const std::vector<Place> places = places_of(manifest, parts, options.words);
  const bool with_times = std::any_of(parts.begin(), parts.end(), [](const BatchTable& part) {
    return part.find("seconds") != nullptr;
  });
  BatchTable table =
      gather_batch(leading_columns(manifest, with_times), places.size(),
                   [&](std::size_t i) { return places[i].part->row(places[i].row); });
  table.about = about_all(parts, options.words);
  return table;
}

}  // namespace rholm::cli
