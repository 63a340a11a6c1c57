#include "cli/commands/reconstruct_report.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/terminal/field_json.h"
#include "cli/terminal/json_text.h"
#include "rholm/error.h"
#include "rholm/points.h"

namespace rholm::cli {
namespace {

std::string size_text(std::uint64_t bytes) {
  return fmt::format("{:.3g} GB", static_cast<double>(bytes) / 1e9);
}

constexpr double kSaid = 0.02;  // share of unsure signs above which a warning is given

// Fraction of the points' area below which a warning is given; noisy points have 0.8.
constexpr double kSaidArea = 0.7;

std::string mended_text(const ReconstructReport& r) {
  return fmt::format("{} of {} normals contradicted their neighbours and were reversed",
                     r.mended_normals, r.points - r.dropped_points);
}

std::string list_of(const std::vector<Vec3>& points) {
  std::string list;
  for (const Vec3& point : points) list += (list.empty() ? "" : "; ") + text_of(point);
  return list;
}

// Throws if points lie on no surface.
void judge_places(const ReconstructReport& r) {
  if (!(r.points_off_surface > kMostOffSurface)) return;
  throw Error(
      ErrorCode::kNotConverged,
      fmt::format("{:.3g} % of the points are away from the surface, throughout the space between "
                  "its walls or around it, first at {}. They fill a volume, which has no surface, "
                  "or their noise exceeds the thickness of the body. The file is written, and is "
                  "wrong there; give points of the surface, or remove the noise",
                  100 * r.points_off_surface, list_of(r.places_off_surface)));
}

// Notes the changes to given normals.
void note_normals(const ReconstructReport& r, Session& session) {
  if (r.crooked_normals > kMostCrooked) {
    session.note(
        fmt::format("{:.3g} % of the given normals are more than 45 degrees off the surface; all "
                    "normals are computed instead",
                    100 * r.crooked_normals));
  }
  if (r.mended_normals > 0) {
    session.note(mended_text(r));
  }
}

// Throws if sheets cross, or normals still contradict each other.
void judge_normals(const ReconstructReport& r) {
  if (r.crossing_length > kMostCrossing) {
    throw Error(ErrorCode::kNotConverged,
                fmt::format("sheets of the points cross each other, first near {}, and bound no "
                            "body. The file is written, and is wrong there; split the points into "
                            "bodies that do not cross, and reconstruct each",
                            list_of(r.crossings)));
  }
  const auto n = static_cast<double>(r.points);
  if (static_cast<double>(r.contradicting_normals) > kMostContradicting * std::sqrt(n)) {
    // Undecided parts have no point that is known to be wrong.
    const std::string first =
        r.contradictions.empty() ? "" : ", first at " + list_of(r.contradictions);
    throw Error(
        ErrorCode::kNotConverged,
        fmt::format("the normals of {} points contradict their neighbours{}: sheets cross there, "
                    "or the signs of given normals are uncertain. The file is written, and may be "
                    "wrong; 'rholm orient --keep-directions' computes new signs",
                    r.contradicting_normals, first));
  }
  if (r.inward_normals > kMostInward) {
    throw Error(
        ErrorCode::kNotConverged,
        fmt::format(
            "{:.3g} % of the given normals point into the solid that the others bound. The file is "
            "written, and may be wrong; leave the normals out, or give correct ones",
            100 * r.inward_normals));
  }
}

}  // namespace

Json json_of(const ReconstructReport& r, bool confidence) {
  Json json = json_of_fields(r);
  json["full_faces"] = r.full_faces;
  json["faces"] = r.faces;
  json["diagonal"] = r.bounds.diagonal();
  json["foreseen_memory"] = r.memory;
  for (const char* key : {"memory", "stored", "bounds", "times", "warnings", "contradictions",
                          "crossings", "places_off_surface"}) {
    json.erase(key);
  }
  if (r.scans.scans <= 1) json.erase("scans");
  if (r.tiles > 1) {
    json["stored_bytes"] = r.stored;
  } else {
    json.erase("tiles");
  }
  if (!confidence) {
    for (const char* key : {"unseen_area", "thin_area", "unsure_area"}) json.erase(key);
  }
  for (const auto& [name, time] : r.times) {
    json["stages"][name] = {{"wall_seconds", time.wall}, {"cpu_seconds", time.cpu}};
  }
  return json;
}

std::string report_text(const ReconstructReport& r, const ReconstructOptions& options) {
  const auto relative = [&](double length) {
    return fmt::format("{} ({:.3g} of the diagonal)", text_of(length),
                       length / r.bounds.diagonal());
  };
  std::string text = line("points", fmt::format("{}", r.points));
  if (r.dropped_points > 0) {
    text += line("dropped",
                 fmt::format("{} (not finite, doubled, or without a normal)", r.dropped_points));
  }
  if (r.tiles > 1) {
    text += line("tiles", fmt::format("{}, {} beside them", r.tiles, size_text(r.stored)));
  }
  if (r.outliers > 0) text += line("outliers", fmt::format("{}, left out", r.outliers));
  if (r.scans.scans > 1) {
    text += line("scans", fmt::format("{}, {} apart, moved by {}: {} apart", r.scans.scans,
                                      text_of(r.scans.distance_before), text_of(r.scans.moved),
                                      text_of(r.scans.distance)));
  }
  if (r.computed_normals) {
    text +=
        line("normals", fmt::format("computed, as by rholm orient: {:.2f} % of their signs unsure",
                                    100 * r.unsure));
  }
  if (r.turned_normals) text += line("normals", "all pointed inwards, turned outwards");
  if (r.mended_normals > 0) {
    text += line("normals", mended_text(r));
  }
  text += line("spacing", relative(r.spacing));
  text += line("noise", r.noise > 0 ? relative(r.noise) : "within what the caps explain");
  text += line("caps", fmt::format("{} of about {} points", r.caps, r.neighbours));
  text += line("grid", fmt::format("cubes of {}", relative(r.step)));
  // Smaller holes lie between caps, also where no points are missing.
  const bool kept = options.holes == HolePolicy::kKeep;
  if ((kept ? r.holes : r.smooth_holes) > 0) {
    text += line("places without data", kept ? fmt::format("{} left open", r.holes)
                                             : fmt::format("{} closed", r.smooth_holes));
  }
  if (r.cut_handles > 0) text += line("small handles", fmt::format("{} cut", r.cut_handles));
  if (r.dropped_components > 0)
    text += line("small parts", fmt::format("{} dropped", r.dropped_components));
  if (r.faces < r.full_faces) {
    text += line("simplified", fmt::format("from {} faces, moved by at most {}", r.full_faces,
                                           relative(r.simplify_error)));
  }
  if (options.confidence) {
    text += line("not known",
                 fmt::format("{:.2f} % of the area is far from data, {:.2f} % thin, {:.2f} "
                             "% below a confidence of 1/2",
                             100 * r.unseen_area, 100 * r.thin_area, 100 * r.unsure_area));
  }
  return text + line("surface", fmt::format("{}, {}", counted(r.vertices, "vertex", "vertices"),
                                            counted(r.faces, "face")));
}

void judge(const ReconstructReport& report, bool filled, Session& session) {
  note_normals(report, session);
  judge_places(report);
  judge_normals(report);
  const double unsure = report.unsure;
  const std::string side =
      fmt::format("the orientation of {:.3g} % of the normals is uncertain", 100 * unsure);
  if (unsure > kTooUnsure) {
    throw Error(ErrorCode::kNotConverged,
                side +
                    ". The file is written, and may be wrong everywhere; give normals, or the "
                    "positions of the sensors (--sensor, or attributes sensor_x, sensor_y, "
                    "sensor_z). Points that fill a volume have no surface");
  }
  if (unsure > kSaid) {
    session.warn(side + ": thin or sparse parts may be wrong; --confidence shows them");
  }
  const double seen = report.area - report.closed_area;
  const double share = seen / report.points_area;
  const std::string much = fmt::format(
      "the surface has {:.3g} times the area of the points. The points contradict each other, as "
      "double walls or misaligned scans do",
      share);
  if (share < kLeastArea || share > kMostArea) {
    throw Error(ErrorCode::kNotConverged,
                much + "; the file is written, and may be wrong everywhere");
  }
  if (share < kSaidArea) session.warn(much);
  if (report.closed_area > report.points_area) {
    session.warn(
        "the area that closes holes exceeds the area of the points: the points are open, for "
        "example from one side; --holes keep leaves the holes open");
  }
  if (filled && report.volume < 0) {
    throw Error(ErrorCode::kNotConverged,
                "the surface encloses a negative volume, because normals point inwards; the file "
                "is written. Reverse the normals, or leave them out");
  }
}

}  // namespace rholm::cli
