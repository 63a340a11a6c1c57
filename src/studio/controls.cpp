#include "studio/controls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "rholm/align.h"
#include "rholm/analyze.h"
#include "rholm/compress.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"
#include "rholm/repair.h"
#include "rholm/smooth.h"
#include "rholm/transfer.h"
#include "studio/answers.h"
#include "studio/names.h"
#include "studio/recipe.h"

namespace rholm::studio {
namespace {

enum class Scale { kLinear, kLog };

// Settings of a control that the panels of the page show. Some ranges are narrower
// than in the list of fields; they are chosen as the useful range of a slider.
struct Shown {
  const char* label;
  std::optional<double> least = {}, most = {}, at = {};  // override the field's values
  double step = 0;                                       // 0: any value, or whole numbers
  Scale scale = Scale::kLinear;
  const char* unit = "";                  // "diagonal": as a part of it; "degrees"
  std::vector<const char*> choices = {};  // labels of the choices, in their order
};

std::string label_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return name;
}

Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// Returns a control as described in docs/studio.md.
Json control(const char* name, const char* help, const char* kind, Json standard) {
  return {{"name", name},    {"label", label_of(name)},  {"help", help},
          {"kind", kind},    {"default", standard},      {"least", nullptr},
          {"most", nullptr}, {"step", nullptr},          {"scale", "linear"},
          {"unit", ""},      {"choices", Json::array()}, {"shown", false}};
}

template <typename V>
Json control_of(const FieldInfo& info, const V& standard) {
  if constexpr (std::is_same_v<V, bool>) {
    return control(info.name, info.help, "flag", standard);
  } else if constexpr (NamedEnum<V>) {
    Json json = control(info.name, info.help, "choice", to_string(standard));
    for (const char* name : names_of(standard).names) {
      json["choices"].push_back({{"value", name}, {"label", label_of(name)}});
    }
    return json;
  } else {
    Json json =
        control(info.name, info.help, std::is_integral_v<V> ? "whole number" : "number", nullptr);
    if constexpr (std::is_arithmetic_v<V>) json["default"] = standard;
    json["least"] = bound(info.least);
    json["most"] = bound(info.most);
    return json;
  }
}

Json shown_as(Json json, const Shown& shown) {
  json["shown"] = true;
  json["label"] = shown.label;
  if (shown.least) json["least"] = *shown.least;
  if (shown.most) json["most"] = *shown.most;
  if (shown.at) json["default"] = *shown.at;
  if (shown.step > 0) json["step"] = shown.step;
  if (shown.scale == Scale::kLog) json["scale"] = "log";
  json["unit"] = shown.unit;
  for (std::size_t i = 0; i < shown.choices.size(); ++i) {
    json["choices"][i]["label"] = shown.choices[i];
  }
  return json;
}

class Controls {
 public:
  explicit Controls(const char* op) : op_(op) {}

  // Adds all fields that requests of the step may have.
  template <HasFields Options>
  Controls&& fields() && {
    const Options standard;
    for_each_field<Options>([&](auto member, const FieldInfo& info) {
      using V = std::remove_cvref_t<decltype(standard.*member)>;
      if constexpr (kIsAsked<V>) {
        if (is_asked<V>(info)) list_.push_back(control_of(info, standard.*member));
      }
    });
    return std::move(*this);
  }
  // Sets how the page shows a field of the list.
  Controls&& show(const char* name, const Shown& shown) && {
    for (Json& json : list_) {
      if (json["name"] == name) json = shown_as(std::move(json), shown);
    }
    return std::move(*this);
  }
  // Adds a number of requests that is not a field of the options.
  Controls&& number(const char* name, const Shown& shown) && {
    list_.push_back(
        shown_as(control(name, "", shown.step == 1 ? "whole number" : "number", nullptr), shown));
    return std::move(*this);
  }
  void add_to(Json& all) && { all[op_] = std::move(list_); }

 private:
  const char* op_;
  Json list_ = Json::array();
};

Json controls() {
  Json all = Json::object();
  Controls("analyze")
      .fields<AnalyzeOptions>()
      .show("degree",
            {.label = "Up to degree", .least = 1, .most = 1024, .at = 32, .scale = Scale::kLog})
      .add_to(all);
  Controls("smooth")
      .fields<PatchOptions>()
      .show("wavelength", {.label = "Wavelength",
                           .least = 0.01,
                           .most = 0.5,
                           .at = 0.08,
                           .scale = Scale::kLog,
                           .unit = "diagonal"})
      .show("fitting", {.label = "Fitting"})  // the page shows both as an action
      .show("repair", {.label = "Repair"})
      .number("strength", {.label = "Strength", .least = -1, .most = 1, .at = 1, .step = 0.01})
      .add_to(all);
  Controls("transfer")
      .fields<TransferOptions>()
      .fields<TransferUpdate>()
      .show("height", {.label = "Height", .least = -2, .most = 4, .step = 0.01})
      .show("scale", {.label = "Scale", .least = 0.2, .most = 5, .scale = Scale::kLog})
      .number("angle", {.label = "Angle", .least = -180, .most = 180, .step = 1, .unit = "degrees"})
      .show("repeat", {.label = "Repeat the texture over the target"})
      .show("remove_own", {.label = "Remove the target's own detail first"})
      .show("refine", {.label = "Refine the target's mesh"})
      .add_to(all);
  Controls("reconstruct")
      .fields<ReconstructOptions>()
      .show("holes", {.label = "Holes", .choices = {"Close all", "Leave open"}})
      .number("simplify", {.label = "Share of faces kept",
                           .least = 0.01,
                           .most = 1,
                           .at = 0.1,
                           .scale = Scale::kLog})
      .add_to(all);
  Controls("simplify")
      .number("faces", {.label = "Faces",
                        .least = 100,  // the shape is still recognisable
                        .at = 10000,
                        .step = 1,
                        .scale = Scale::kLog})
      .add_to(all);
  // Below the least tolerance caps are no smaller than the mesh.
  Controls("compress")
      .fields<CompressOptions>()
      .number("tolerance", {.label = "Allowed error, rms",
                            .least = 1e-4,
                            .most = 3e-2,
                            .at = 3e-3,
                            .scale = Scale::kLog,
                            .unit = "diagonal"})
      .show("max_degree", {.label = "Highest degree of a cap"})
      .add_to(all);
  Controls("align")
      .fields<AlignOptions>()
      .show("mirror", {.label = "Try mirror images as well"})
      .add_to(all);
  Controls("blend")
      .number("t",
              {.label = "Blend towards the other", .least = 0, .most = 1, .at = 0, .step = 0.005})
      .add_to(all);
  Controls("orient").fields<OrientOptions>().add_to(all);
  Controls("repair").fields<RepairOptions>().add_to(all);
  return all;
}

// Negative values would be parsed as options.
std::string value_text(const std::string& value) {
  return (value.starts_with('-') ? "=" : " ") + value;
}

std::string option_text(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return " --" + name;
}

}  // namespace

void Arguments::flag(const std::string& name) {
  shell += option_text(name);
  python += ", " + name + "=True";
}

void Arguments::number(const std::string& name, double value) {
  shell += option_text(name) + value_text(digits(value));
  python += ", " + name + "=" + digits(value);
}

void Arguments::choice(const std::string& name, const std::string& value) {
  shell += option_text(name) + value_text(value);
  python += ", " + name + "=" + python_text(value);
}

Response controls_answer() { return json_response(controls()); }

}  // namespace rholm::studio
