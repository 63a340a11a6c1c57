// A cell is what a pixel shows at its middle. Each cell sends some rays to the sky and to
// the key, different from its neighbours' rays. Each window of 4 x 4 cells has a whole
// Hammersley set (Keller, Heidrich 2001, "Interleaved sampling"). The mean over the cells of
// a window on the same surface is the light of each cell. First, one of 2 x 2 cells, a
// scout, sends one ray to the sky and one to the key. Where all scouts of a window are free,
// no cell sends more rays. If a part b of evenly spread directions is blocked, 16 of them
// are all free with a probability below (1 - b)^16. At most max b (1 - b)^16 = 0.02 of a
// light is thus overlooked on average, one or two of 255 levels. A cell sends its own rays
// if no scout around it is on its surface. Finally, pixels that differ from their neighbours
// take the mean of several rays of sight, whose places are lit like the pixel's middle.
#include "report/picture/shared_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "report/picture/light_kernels.h"

namespace rholm {
namespace {

constexpr int kBlock = 4;  // cells of a block along its side
// Margins of cells around the pixels: for edge pixels, windows of means, scouts, their windows.
constexpr int kAskMargin = 1 + kReach, kScoutMargin = kAskMargin + kScouts;
constexpr int kMargin = kScoutMargin + kReach * kScouts;
constexpr std::size_t kRows = 4;  // rows per chunk: some 5 ms

// Pixels whose square roots of brightness differ by more are edges: some 15 of 255 grey levels.
// Measured by scripts/render-figures: at 0.08 Bennu is as far from many rays as fine pictures are.
constexpr float kStep = 0.06f;
// Key rays of a cell whose window sees the key partly: 36 in 3 x 3 cells, as fine pictures
// have for both lights. Measured by scripts/render-figures: 9 rays improve by 1 to 5 %.
constexpr int kKeyRays = 4;
const Color kPaper = {1, 1, 1};

constexpr double kGolden = 0.6180339887498949;

struct Shared {
  float sky, key;  // free parts
};

// Strip of cells, with one array per value.
struct Cells {
  int left = 0, top = 0, width = 0;
  std::array<std::vector<float>, kCellNumbers> numbers;
  std::vector<Vec3> faces;
  std::vector<Finish> finishes;
  std::vector<Shared> shared;
  // By all of a cell's own rays: the free part of the sky,
  // and the sums of cosines of key rays, all and free ones.
  struct Own {
    float sky, key_all, key_free;
  };
  std::vector<Own> own;
  std::vector<std::uint8_t> mixed_sky, mixed_key;  // the window sees only a part of the light
  std::vector<Color> colors;

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y - top) * width + (x - left);
  }
  bool seen(std::size_t cell) const { return numbers[kSide][cell] != 0; }
  CellRow row(int x, int y) const {
    CellRow row{.numbers = {}, .width = width};
    for (int k = 0; k < kCellNumbers; ++k) row.numbers[k] = &numbers[k][at(x, y)];
    return row;
  }
  Place place(std::size_t cell) const {
    const auto of = [&](CellNumber number) { return numbers[number][cell]; };
    Place place;
    place.point = {of(kX), of(kY), of(kZ)};
    place.face = faces[cell];
    place.normal = {of(kNormalX), of(kNormalY), of(kNormalZ)};
    return place;
  }
};

template <typename Work>
void for_each_array(Cells& cells, const Work& work) {
  for (std::vector<float>& numbers : cells.numbers) work(numbers);
  work(cells.faces);
  work(cells.finishes);
  work(cells.shared);
  work(cells.own);
  work(cells.mixed_sky);
  work(cells.mixed_key);
  work(cells.colors);
}

Cells make_cells(int left, int right, int rows) {
  Cells cells;
  cells.left = left;
  cells.width = right - left;
  const std::size_t n = static_cast<std::size_t>(cells.width) * rows + kReadBeyond;
  for_each_array(cells, [&](auto& array) { array.resize(n); });
  return cells;
}

// Moves rows: the row `first` becomes the first one.
void move_up(Cells& cells, int first, int rows) {
  const std::ptrdiff_t width = cells.width;
  for_each_array(cells, [&](auto& array) {
    std::copy_n(array.begin() + first * width, rows * width, array.begin());
  });
}

Spot spot_of(const Place& place) {
  const auto& [p, n] = std::pair(place.point, place.normal);
  return {static_cast<float>(p.x),  static_cast<float>(p.y), static_cast<float>(p.z),
          static_cast<float>(n.x),  static_cast<float>(n.y), static_cast<float>(n.z),
          place.back ? -1.0f : 1.0f};
}
Spot spot_of(const Cells& cells, std::size_t k) {
  const auto of = [&](CellNumber number) { return cells.numbers[number][k]; };
  return {of(kX), of(kY), of(kZ), of(kNormalX), of(kNormalY), of(kNormalZ), of(kSide)};
}

bool is_scout(int k) { return k % kScouts == 0; }
// Returns the scout at a row or column, or the one before it.
int scout_before(int k) { return k - (k & (kScouts - 1)); }

// Interleaves the bits of x ^ y and y, lowest first, so neighbours are far apart in the set.
std::size_t place_in_block(int x, int y) {
  const unsigned a = static_cast<unsigned>(x ^ y), b = static_cast<unsigned>(y);
  return (a & 1) * 8 + (b & 1) * 4 + (a & 2) + (b & 2) / 2;
}

// Returns the rays of a cell: a pixel's own rays, shared by all cells of a block.
int sky_rays(const RenderOptions& options) {
  if (options.occlusion_rays == 0) return 0;
  constexpr int kCells = kBlock * kBlock;
  constexpr int kLeast = 3;  // chosen by eye: less than 48 directions leave bands
  const int rays = options.samples * options.samples * options.occlusion_rays;
  return std::max(kLeast, (rays + kCells - 1) / kCells);
}

// Ray r of all cells of a block is a Hammersley set, and so are all rays, shifted within strata.
std::vector<LightSamples::Polar> sky_of_block(int rays) {
  std::vector<LightSamples::Polar> points;
  for (unsigned at = 0; at < kBlock * kBlock; ++at) {
    const unsigned reversed = (at & 1) * 8 + (at & 2) * 2 + (at & 4) / 2 + (at & 8) / 8;
    for (int r = 0; r < rays; ++r) {
      const double angle = 2 * std::numbers::pi * (reversed / 16.0 + r * kGolden);
      points.push_back({(at + (r + 0.5) / rays) / 16, std::cos(angle), std::sin(angle)});
    }
  }
  return points;
}

// Returns a golden-ratio lattice in the unit square, centred. It is the
// same in all pixels, so that an edge through many pixels is smooth.
std::vector<PlanePoint> places_in_pixel(int n) {
  std::vector<PlanePoint> places;
  double mean = 0;
  for (int k = 0; k < n; ++k) {
    const double y = k * kGolden + 0.25;
    places.push_back({(k + 0.5) / n, y - std::floor(y)});
    mean += places.back().y / n;
  }
  for (PlanePoint& place : places) place.y += 0.5 - mean;
  return places;
}

class Drawing {
 public:
  Drawing(Canvas& canvas, const PanelPicture& panel, const RayScene& scene,
          const RenderOptions& options)
      : canvas_(canvas),
        panel_(panel),
        scene_(scene),
        side_(options.samples),
        sky_rays_(sky_rays(options)),
        own_(make_light_samples(side_ * side_, options.occlusion_rays)),
        shared_sky_(sky_of_block(sky_rays_)),
        more_key_(make_light_samples(kKeyRays, 0).key),
        places_(places_in_pixel(side_ * side_)),
        per_depth_(static_cast<float>(0.5 * panel.pixels_per_unit / kDepth)) {
    for (const LightSamples::Polar& point : make_light_samples(kBlock * kBlock, 0).key) {
      shared_key_.push_back(key_direction(panel.lamps, point, {}));
    }
  }

  void see(Cells& cells, int y) const;
  void scout(Cells& cells, int y) const;
  void ask(Cells& cells, int y) const;
  void share(Cells& cells, int y) const;
  void resolve(const Cells& cells, int y) const;

 private:
  const LightSamples::Polar& sky_point(std::size_t at, int ray) const {
    return shared_sky_[at * static_cast<std::size_t>(sky_rays_) + ray];
  }
  void hear_scouts(Cells& cells, int x, int y) const;

  Canvas& canvas_;
  const PanelPicture& panel_;
  const RayScene& scene_;
  int side_;
  int sky_rays_;
  LightSamples own_;
  std::vector<LightSamples::Polar> shared_sky_, more_key_;
  std::vector<Vec3> shared_key_;    // one for each cell of a block
  std::vector<PlanePoint> places_;  // sample positions in an edge pixel
  float per_depth_;
};

void set_roots(Cells& cells, std::size_t cell) {
  const Color& color = cells.colors[cell];
  cells.numbers[kRed][cell] = std::sqrt(color.r);
  cells.numbers[kGreen][cell] = std::sqrt(color.g);
  cells.numbers[kBlue][cell] = std::sqrt(color.b);
}

// Casts the rays of sight and the shared rays.
void Drawing::see(Cells& cells, int y) const {
  std::vector<Ray> sight, sky, key;
  std::vector<std::size_t> of_sky, of_key;
  sight.reserve(static_cast<std::size_t>(cells.width));
  for (int k = 0; k < cells.width; ++k) sight.push_back(panel_.ray(cells.left + k + 0.5, y + 0.5));
  const std::vector<RayHit> hits = scene_.first_hits(sight);
  for (int x = cells.left; x < cells.left + cells.width; ++x) {
    const auto k = static_cast<std::size_t>(x - cells.left);
    const std::size_t cell = cells.at(x, y);
    cells.numbers[kSide][cell] = 0;
    cells.colors[cell] = kPaper;
    set_roots(cells, cell);
    look_ahead(panel_.subject, hits, k);
    if (!hits[k].hit) continue;
    const Place place = place_of(panel_.subject, sight[k], hits[k]);
    const std::size_t at = place_in_block(scout_before(x) / kScouts, scout_before(y) / kScouts);
    const Vec3& to_key = shared_key_[at];
    const auto cosine = static_cast<float>(std::max(0.0, dot(to_key, place.normal)));
    const Spot spot = spot_of(place);
    const float numbers[] = {spot.x,        spot.y,    spot.z, spot.normal_x, spot.normal_y,
                             spot.normal_z, spot.side, 1,      cosine,        cosine};
    for (std::size_t n = 0; n < std::size(numbers); ++n) cells.numbers[n][cell] = numbers[n];
    cells.faces[cell] = place.face;
    cells.finishes[cell] = finish(panel_.subject, panel_.lamps, panel_.scale, place);
    cells.own[cell] = {1, cosine, cosine};
    if (!is_scout(x) || !is_scout(y)) continue;
    if (sky_rays_ > 0) {
      sky.push_back({place.point, sky_direction(place, sky_point(at, 0), {})});
      of_sky.push_back(cell);
    }
    if (cosine > 0 && dot(to_key, place.face) > 0) {
      key.push_back({place.point, to_key});
      of_key.push_back(cell);
    }
  }
  const std::vector<bool> no_sky = scene_.occluded(sky), no_key = scene_.occluded(key);
  for (std::size_t k = 0; k < sky.size(); ++k) {
    if (no_sky[k]) cells.numbers[kSky][of_sky[k]] = 0;
  }
  for (std::size_t k = 0; k < key.size(); ++k) {
    if (no_key[k]) cells.numbers[kKeyFree][of_key[k]] = 0;
  }
}

// Determines for each scout's window whether it sees a light fully, partly, or not.
void Drawing::scout(Cells& cells, int y) const {
  if (!is_scout(y)) return;
  const int before = kReach * kScouts, end = cells.left + cells.width - before;
  const int begin = scout_before(cells.left + before + kScouts - 1);
  const int n = (end - begin + kScouts - 1) / kScouts;
  const WindowSums w = sum_windows(cells.row(begin, y), static_cast<std::size_t>(n), per_depth_);
  for (int k = 0; k < n; ++k) {
    const std::size_t cell = cells.at(begin + k * kScouts, y);
    cells.mixed_sky[cell] = w.sky[k] < w.all[k];
    cells.mixed_key[cell] = w.key_free[k] > 0 && w.key_free[k] < w.key_all[k];
    // All, or none.
    cells.shared[cell] = {1, w.key_free[k] > 0 || !(w.key_all[k] > 0) ? 1.0f : 0.0f};
  }
}

// A cell that is no scout sends rays if a scout around it on the
// same surface does, if these scouts disagree, or if there is none.
void Drawing::hear_scouts(Cells& cells, int x, int y) const {
  const std::size_t cell = cells.at(x, y);
  const Spot spot = spot_of(cells, cell);
  int heard = 0, lit = 0;
  bool mixed_sky = false, mixed_key = false;
  for (int v = scout_before(y); v < y + kScouts; v += kScouts) {
    for (int u = scout_before(x); u < x + kScouts; u += kScouts) {
      const std::size_t scout = cells.at(u, v);
      if (!(likeness(spot, spot_of(cells, scout), per_depth_) > 0)) continue;
      ++heard;
      lit += cells.shared[scout].key > 0;
      mixed_sky = mixed_sky || cells.mixed_sky[scout];
      mixed_key = mixed_key || cells.mixed_key[scout];
    }
  }
  const bool seen = cells.seen(cell);
  cells.mixed_sky[cell] = seen && sky_rays_ > 0 && (mixed_sky || heard == 0);
  cells.mixed_key[cell] = seen && (mixed_key || heard == 0 || (lit > 0 && lit < heard));
  cells.shared[cell] = {1, lit > 0 ? 1.0f : 0.0f};
}

// Casts the rays of cells whose windows see a light partly.
void Drawing::ask(Cells& cells, int y) const {
  std::vector<Ray> sky, key;
  std::vector<std::size_t> of_sky, of_key;
  std::vector<float> cosines;
  const int before = kMargin - kAskMargin;
  for (int x = cells.left + before; x < cells.left + cells.width - before; ++x) {
    if (!is_scout(x) || !is_scout(y)) hear_scouts(cells, x, y);
    const std::size_t cell = cells.at(x, y);
    if (cells.mixed_sky[cell]) {
      const Place place = cells.place(cell);
      for (int r = 0; r < sky_rays_; ++r) {
        sky.push_back({place.point, sky_direction(place, sky_point(place_in_block(x, y), r), {})});
        of_sky.push_back(cell);
      }
    }
    if (!cells.mixed_key[cell]) {
      if (!(cells.shared[cell].key > 0)) cells.own[cell].key_free = 0;
      continue;
    }
    cells.own[cell] = {1, 0, 0};
    const Place place = cells.place(cell);
    const PixelShift shift = pixel_shift(pixel_seed(x, y));
    for (const LightSamples::Polar& point : more_key_) {
      const Vec3 to_key = key_direction(panel_.lamps, point, shift);
      const auto cosine = static_cast<float>(std::max(0.0, dot(to_key, place.normal)));
      cells.own[cell].key_all += cosine;
      cells.own[cell].key_free += cosine;
      if (!(cosine > 0 && dot(to_key, place.face) > 0)) continue;
      key.push_back({place.point, to_key});
      of_key.push_back(cell);
      cosines.push_back(cosine);
    }
  }
  const std::vector<bool> no_sky = scene_.occluded(sky), no_key = scene_.occluded(key);
  for (std::size_t k = 0; k < sky.size(); ++k) {
    if (no_sky[k]) cells.own[of_sky[k]].sky -= 1 / static_cast<float>(sky_rays_);
  }
  for (std::size_t k = 0; k < key.size(); ++k) {
    if (no_key[k]) cells.own[of_key[k]].key_free -= cosines[k];
  }
}

// Takes means over windows, 3 x 3 cells for the key with its sharp shadows; then sets colours.
void Drawing::share(Cells& cells, int y) const {
  for (int x = cells.left + kMargin - 1; x < cells.left + cells.width - kMargin + 1; ++x) {
    const std::size_t cell = cells.at(x, y);
    if (!cells.seen(cell)) continue;
    const bool mixed_sky = cells.mixed_sky[cell], mixed_key = cells.mixed_key[cell];
    const int reach = mixed_sky ? kReach : mixed_key ? 1 : -1;
    const Spot spot = spot_of(cells, cell);
    float all = 0, sky = 0, key_all = 0, key_free = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const std::size_t other = cells.at(x + dx, y + dy);
        const float alike = likeness(spot, spot_of(cells, other), per_depth_);
        const float weight = alike * kTent[dx + kReach] * kTent[dy + kReach];
        all += weight;
        sky += weight * cells.own[other].sky;
        if (std::max(std::abs(dx), std::abs(dy)) > 1) continue;
        key_all += alike * cells.own[other].key_all;
        key_free += alike * cells.own[other].key_free;
      }
    }
    Shared& shared = cells.shared[cell];
    if (mixed_sky) shared.sky = sky / all;
    if (mixed_key && key_all > 0) shared.key = std::max(0.0f, key_free / key_all);
    cells.colors[cell] = cells.finishes[cell].lit(shared.sky, shared.key);
    set_roots(cells, cell);
  }
}

// Takes the mean of several places of an edge pixel. They are lit like
// its middle if all are on its surface, otherwise by their own rays.
void Drawing::resolve(const Cells& cells, int y) const {
  std::vector<int> edges;
  std::vector<Ray> rays;
  const int begin = cells.left + kMargin, end = cells.left + cells.width - kMargin;
  const std::vector<std::uint8_t> is_edge =
      find_edges(cells.row(begin, y), static_cast<std::size_t>(end - begin), per_depth_, kStep);
  for (int x = begin; x < end; ++x) {
    canvas_.at(x, y) = cells.colors[cells.at(x, y)];
    if (side_ == 1 || !is_edge[x - begin]) continue;
    edges.push_back(x);
    for (const PlanePoint& p : places_) rays.push_back(panel_.ray(x + p.x, y + p.y));
  }
  const std::vector<RayHit> hits = scene_.first_hits(rays);
  std::vector<Place> places;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::size_t n = places_.size(), cell = cells.at(edges[k], y);
    const Spot middle = spot_of(cells, cell);
    places.clear();
    bool alike = true;
    for (std::size_t i = k * n; i < (k + 1) * n; ++i) {
      look_ahead(panel_.subject, hits, i);
      if (!hits[i].hit) continue;
      places.push_back(place_of(panel_.subject, rays[i], hits[i]));
      alike = alike && likeness(middle, spot_of(places.back()), per_depth_) > 0;
    }
    Color sum = static_cast<float>(n - places.size()) * kPaper;
    const PixelShift shift = alike ? PixelShift{} : pixel_shift(pixel_seed(edges[k], y));
    const Shared& shared = cells.shared[cell];
    for (std::size_t i = 0; i < places.size(); ++i) {
      sum = sum + (alike ? finish(panel_.subject, panel_.lamps, panel_.scale, places[i])
                               .lit(shared.sky, shared.key)
                         : shade(panel_.subject, scene_, panel_.lamps, panel_.scale, own_, shift,
                                 places[i], static_cast<int>(i)));
    }
    canvas_.at(edges[k], y) = (1 / static_cast<float>(n)) * sum;
  }
}

}  // namespace

void draw_shared(Canvas& canvas, const PanelPicture& p, const RayScene& scene,
                 const RenderOptions& options, const Context& context, const ParallelStage& stage,
                 int strip_cells) {
  const Drawing drawing(canvas, p, scene, options);
  // Range of pixels that the subject may touch.
  const double half_width = 0.5 * p.box.width() * p.pixels_per_unit + 1;
  const double half_height = 0.5 * p.box.height() * p.pixels_per_unit + 1;
  const int left = std::max(p.left, static_cast<int>(std::floor(p.center_x - half_width)));
  const int right = std::min(p.right, static_cast<int>(std::ceil(p.center_x + half_width)));
  const int top = std::max(0, static_cast<int>(std::floor(p.center_y - half_height)));
  const int bottom = std::min(p.height, static_cast<int>(std::ceil(p.center_y + half_height)));
  if (left >= right || top >= bottom) return;
  const int rows = std::max(64, strip_cells / (right - left + 2 * kMargin));
  Cells cells =
      make_cells(left - kMargin, right + kMargin, std::min(rows, bottom - top) + 2 * kMargin);
  for (int first = top; first < bottom; first += rows) {
    if (first > top) move_up(cells, rows, 2 * kMargin);
    cells.top = first - kMargin;
    const int last = std::min(first + rows, bottom);
    const double strip = (stage.to - stage.from) * (last - first) / (bottom - top);
    double from = stage.from + (stage.to - stage.from) * (first - top) / (bottom - top);
    // Each pass continues where it ended in the strip above.
    const auto pass = [&](int margin, double part, const auto& work) {
      const double to = std::min(stage.to, from + part * strip);
      const int next = first > top ? first + margin : first - margin;
      parallel_for(static_cast<std::size_t>(last + margin - next), kRows, context,
                   {stage.name, from, to}, [&](std::size_t begin, std::size_t end) {
                     for (std::size_t k = begin; k < end; ++k) work(next + static_cast<int>(k));
                   });
      from = to;
    };
    pass(kMargin, 0.4, [&](int y) { drawing.see(cells, y); });
    pass(kScoutMargin, 0.1, [&](int y) { drawing.scout(cells, y); });
    pass(kAskMargin, 0.2, [&](int y) { drawing.ask(cells, y); });
    pass(1, 0.1, [&](int y) { drawing.share(cells, y); });
    pass(0, 0.2, [&](int y) { drawing.resolve(cells, y); });
  }
}

}  // namespace rholm
