// Convex hulls by Qhull.
#include <libqhull_r/qhull_ra.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "paper/patches/hull_facets.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Owns Qhull's memory and its messages, which are not printed.
class Hull {
 public:
  Hull() : messages_(open_memstream(&text_, &size_)) {
    if (!messages_) throw std::bad_alloc();
    qh_zero(&qh_, messages_);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;
  ~Hull() {
    int pieces = 0, bytes = 0;
    qh_freeqhull(&qh_, !qh_ALL);
    qh_memfreeshort(&qh_, &pieces, &bytes);
    std::fclose(messages_);
    std::free(text_);
  }

  // `coordinates` must live as long as the hull. Returns false if the points are in a plane.
  bool build(std::span<double> coordinates) {
    char command[] = "qhull Qt Pp";  // simplices only, no warnings about narrow hulls
    const int code = qh_new_qhull(&qh_, 3, static_cast<int>(coordinates.size() / 3),
                                  coordinates.data(), False, command, nullptr, messages_);
    if (code == qh_ERRmem) throw std::bad_alloc();
    if (code != 0 && code != qh_ERRsingular) {
      throw Error(ErrorCode::kInvalidInput,
                  "Qhull finds no Delaunay triangulation of " +
                      std::to_string(coordinates.size() / 3) + " directions (its exit code is " +
                      std::to_string(code) + "); merge points that nearly coincide");
    }
    return code == 0;
  }

  // Calls visit with the three points of each facet.
  template <typename Visit>
  void for_each_facet(const Visit& visit) {
    qhT* const qh = &qh_;  // the name that Qhull's macros require
    facetT* facet = nullptr;
    FORALLfacets {
      Triangle corners{};
      std::size_t n = 0;
      vertexT *vertex = nullptr, **vertexp = nullptr;
      FOREACHvertex_(facet->vertices) {
        if (n < 3) corners[n] = static_cast<std::uint32_t>(qh_pointid(qh, vertex->point));
        ++n;
      }
      if (n == 3) visit(corners);
    }
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* messages_;
  qhT qh_{};
};

}  // namespace

std::vector<Triangle> hull_facets(std::span<double> coordinates) {
  std::vector<Triangle> facets;
  Hull hull;
  if (!hull.build(coordinates)) return facets;
  hull.for_each_facet([&](const Triangle& facet) { facets.push_back(facet); });
  return facets;
}

}  // namespace rholm
