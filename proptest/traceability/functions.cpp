// Written by tools/check_traceability.py --write from spec/traceability.md.
// clang-format off

#include "halfspace/bsp_tree.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/image/behind.hpp"
#include "halfspace/fast/image/depth_sort.hpp"
#include "halfspace/fast/image/flat_scene.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/image/moving.hpp"
#include "halfspace/fast/image/screens.hpp"
#include "halfspace/fast/image/seen_areas.hpp"
#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/fast/order_feed.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/scan.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/fast/self_intersections.hpp"
#include "halfspace/fast/shade/back_faces.hpp"
#include "halfspace/fast/shade/color_forms.hpp"
#include "halfspace/fast/shade/lines.hpp"
#include "halfspace/fast/shade/look.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/fast/splitter.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/line_style.hpp"
#include "halfspace/moving.hpp"
#include "halfspace/panorama.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/ref/area_image.hpp"
#include "halfspace/ref/behind.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/classify.hpp"
#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/depth_sort.hpp"
#include "halfspace/ref/drawing.hpp"
#include "halfspace/ref/lines.hpp"
#include "halfspace/ref/moving.hpp"
#include "halfspace/ref/oracle/look.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "halfspace/ref/order_feed.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/ray.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/scalars.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/ref/screens.hpp"
#include "halfspace/ref/seen_areas.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/split.hpp"
#include "halfspace/ref/splitter.hpp"
#include "halfspace/ref/traverse.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "halfspace/ref/winding.hpp"
#include "halfspace/region.hpp"
#include "halfspace/scalars.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/scene_file.hpp"

#include <cstddef>
#include <cstdio>

namespace halfspace {
namespace {

std::size_t taken = 0;

template <class Function>
void take(Function* function) {
  Function* volatile kept = function;
  if (kept != nullptr) ++taken;
}
template <class Class, class Member>
void take(Member Class::*member) {
  Member Class::*volatile kept = member;
  if (kept != nullptr) ++taken;
}

void take_all() {
  take(&grid_bits_for);  // S1.1
  take(&read_scene);  // S1.2
  take(&write_scene);  // S1.2
  take(&make_scene);  // S1.3
  take(&ref::plane_of);  // S1.4
  take(&fast::plane_of);  // S1.4
  take(&fast::intern_planes);  // S1.4
  take(&ref::side_of);  // S1.5
  take(&ref::value_at);  // S1.5
  take(&fast::side_of);  // S1.5
  take(&ref::planes_of);  // S1.6
  take(&fast::planes_of);  // S1.6
  take(&io::import_scene);  // S1.7
  take(&ref::rounded);  // S1.8
  take(&fast::rounded_mesh);  // S1.8
  take(&ref::relation);  // S2.1
  take(&fast::relation);  // S2.1
  {  // S2.2
    using namespace ref;
    using Kind = Fragment(const Scene&, PolygonId);
    take<Kind>(&ref::whole);
  }
  {  // S2.2
    using namespace ref;
    using Kind = FragmentName(const Fragment&);
    take<Kind>(&ref::name_of);
  }
  take(&fast::whole);  // S2.2
  {  // S2.2
    using namespace fast;
    using Kind = FragmentName(const Fragment&);
    take<Kind>(&fast::name_of);
  }
  take(&ref::split);  // S2.3
  {  // S2.3
    using namespace fast;
    using Kind = SplitResult(const Scene&, const Fragment&, PolygonId, FilterStats&);
    take<Kind>(&fast::split);
  }
  {  // S3.1
    using namespace ref;
    using Kind = TreeName(const BspTree&);
    take<Kind>(&ref::name_of);
  }
  {  // S3.1
    using namespace fast;
    using Kind = TreeName(const BspTree&);
    take<Kind>(&fast::name_of);
  }
  take(&ref::stats);  // S3.2
  take(&fast::stats);  // S3.2
  take(&ref::choose_root);  // S3.3
  take(&fast::choose_root);  // S3.3
  take(&draw);  // S3.4
  take(&mix);  // S3.4
  {  // S3.5
    using namespace ref;
    using Kind = BspTree(const Scene&, const BuildOptions&);
    take<Kind>(&ref::build);
  }
  {  // S3.5
    using namespace fast;
    using Kind = BspTree(const Scene&, const BuildOptions&);
    take<Kind>(&fast::build);
  }
  take(&ref::insert);  // S3.6
  {  // S3.6
    using namespace fast;
    using Kind = void(BspTree&, const Scene&, PolygonId);
    take<Kind>(&fast::insert);
  }
  take(&ref::front_to_back);  // S3.7
  take(&ref::back_to_front);  // S3.7
  take(&fast::front_to_back);  // S3.7
  take(&fast::back_to_front);  // S3.7
  take(&ref::ordered_triangles);  // S3.8
  take(&fast::order_indices);  // S3.8
  take(&ref::depth_sort);  // S3.9
  take(&fast::depth_sort);  // S3.9
  take(&ref::is_behind);  // S3.10
  take(&fast::is_behind);  // S3.10
  take(&fast::count_behind);  // S3.10
  take(&ref::remove);  // S3.11
  take(&fast::remove);  // S3.11
  {  // S3.12
    using namespace fast;
    using Kind = Rendering(const LazyTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  {  // S3.12
    using namespace fast;
    using Kind = Rendering(const LazyTree&, const Camera&, const ImageOptions&, std::int32_t, const RenderOptions&);
    take<Kind>(&fast::render_samples);
  }
  take(&make_camera);  // S4.1
  take(&ref::side_of_eye);  // S4.2
  take(&fast::side_of_eye);  // S4.2
  take(&ref::clip);  // S4.3
  {  // S4.3
    using namespace fast;
    using Kind = std::vector<ObjectSegment>(const Scene&, const Fragment&, const Camera&, FilterStats&, SimdLevel);
    take<Kind>(&fast::scan_convert);
  }
  take(&ref::scan_convert);  // S4.4
  {  // S4.4
    using namespace fast;
    using Kind = std::vector<ObjectSegment>(const Scene&, const Fragment&, const Camera&, FilterStats&, SimdLevel);
    take<Kind>(&fast::scan_convert);
  }
  take(&ref::scan_convert);  // S4.5
  {  // S4.5
    using namespace fast;
    using Kind = std::vector<ObjectSegment>(const Scene&, const Fragment&, const Camera&, FilterStats&, SimdLevel);
    take<Kind>(&fast::scan_convert);
  }
  take(&ref::scan_convert);  // S4.6
  {  // S4.6
    using namespace fast;
    using Kind = std::vector<ObjectSegment>(const Scene&, const Fragment&, const Camera&, FilterStats&, SimdLevel);
    take<Kind>(&fast::scan_convert);
  }
  take(&ref::merge_case);  // S4.7
  take(&ref::merge_segment);  // S4.7
  take(&fast::merge_case);  // S4.7
  take(&ref::merge);  // S4.8
  take(&fast::DynamicScreen::light);  // S4.8
  take(&ref::render_on);  // S4.9
  take(&fast::render_on);  // S4.9
  take(&ref::render);  // S5.1
  {  // S5.1
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  take(&ref::render);  // S5.2
  {  // S5.2
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  take(&ref::render);  // S5.3
  {  // S5.3
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  take(&ref::color_at);  // S5.4
  take(&ref::colors_of);  // S5.4
  {  // S5.4
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  take(&ref::render);  // S5.5
  take(&ref::paint);  // S5.5
  take(&ref::zbuffer);  // S5.5
  take(&ref::raycast);  // S5.5
  {  // S5.5
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  {  // S5.5
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::paint);
  }
  take(&ref::blend);  // S5.6
  {  // S5.6
    using namespace ref;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const Look&);
    take<Kind>(&ref::render_look);
  }
  {  // S5.6
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, std::uint8_t, const RenderOptions&);
    take<Kind>(&fast::blend);
  }
  {  // S5.6
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const Look&, const RenderOptions&, const ScalarColors*);
    take<Kind>(&fast::render_look);
  }
  take(&ref::render_samples);  // S5.7
  {  // S5.7
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, std::int32_t, const RenderOptions&);
    take<Kind>(&fast::render_samples);
  }
  take(&ref::mark_back_faces);  // S5.8
  take(&fast::mark_back_faces);  // S5.8
  take(&ref::bad_edges);  // S6.1
  take(&fast::bad_edges);  // S6.1
  take(&ref::to_solid);  // S6.2
  take(&ref::winding_beside);  // S6.2
  take(&ref::is_solid);  // S6.2
  {  // S6.2
    using namespace fast;
    using Kind = fast::Solid(const halfspace::GridSolid&, std::int32_t);
    take<Kind>(&fast::to_solid);
  }
  take(&fast::check_operand);  // S6.2
  take(&ref::classify);  // S6.3
  take(&fast::boolean);  // S6.3
  take(&ref::keep);  // S6.4
  take(&fast::boolean);  // S6.4
  take(&ref::boolean);  // S6.5
  take(&fast::boolean);  // S6.5
  take(&ref::is_solid);  // S6.6
  take(&fast::self_intersections);  // S6.6
  take(&ref::resolve);  // S6.7
  take(&fast::resolve);  // S6.7
  take(&fast::rounded_mesh);  // S6.8
  take(&fast::settled_scene);  // S6.8
  take(&fast::canonical);  // S6.10
  take(&ref::visible_map);  // S7.1
  take(&fast::visible_map);  // S7.1
  take(&ref::visible_map);  // S7.2
  take(&fast::visible_map);  // S7.2
  take(&ref::visible_map);  // S7.3
  take(&fast::visible_map);  // S7.3
  take(&ref::visible_map);  // S7.4
  take(&fast::visible_map);  // S7.4
  take(&ref::area_of_key);  // S7.5
  take(&fast::visible_map);  // S7.5
  take(&ref::render_area);  // S7.6
  take(&fast::render_area);  // S7.6
  take(&ref::seen_areas);  // S7.7
  take(&panorama);  // S7.7
  take(&fast::seen_areas);  // S7.7
  take(&ref::transparent_map);  // S7.8
  take(&fast::transparent_map);  // S7.8
  take(&ref::exact_color_at);  // S7.9
  take(&fast::color_forms);  // S7.9
  take(&make_ray);  // S8.1
  take(&ref::all_hits);  // S8.2
  take(&ref::distance_of);  // S8.2
  {  // S8.2
    using namespace fast;
    using Kind = std::vector<RayHit>(const Scene&, const BspTree&, const Ray&);
    take<Kind>(&fast::all_hits);
  }
  {  // S8.2
    using namespace fast;
    using Kind = std::vector<RayHit>(const LazyTree&, const Ray&);
    take<Kind>(&fast::all_hits);
  }
  take(&ref::all_hits);  // S8.3
  {  // S8.3
    using namespace fast;
    using Kind = std::optional<RayHit>(const Scene&, const BspTree&, const Ray&);
    take<Kind>(&fast::first_hit);
  }
  {  // S8.3
    using namespace fast;
    using Kind = std::optional<RayHit>(const LazyTree&, const Ray&);
    take<Kind>(&fast::first_hit);
  }
  take(&ref::pick);  // S8.4
  {  // S8.4
    using namespace fast;
    using Kind = PolygonId(const Scene&, const BspTree&, const Camera&, const ImageOptions&, std::int32_t, std::int32_t);
    take<Kind>(&fast::pick);
  }
  {  // S8.4
    using namespace fast;
    using Kind = PolygonId(const LazyTree&, const Camera&, const ImageOptions&, std::int32_t, std::int32_t);
    take<Kind>(&fast::pick);
  }
  take(&ref::see_each_other);  // S8.5
  {  // S8.5
    using namespace fast;
    using Kind = bool(const Scene&, const BspTree&, const Ray&);
    take<Kind>(&fast::see_each_other);
  }
  {  // S8.5
    using namespace fast;
    using Kind = bool(const LazyTree&, const Ray&);
    take<Kind>(&fast::see_each_other);
  }
  take(&ref::draw);  // S9.1
  take(&fast::draw);  // S9.1
  take(&ref::draw);  // S9.2
  take(&fast::draw);  // S9.2
  take(&ref::draw);  // S9.3
  take(&fast::draw);  // S9.3
  take(&ref::draw);  // S9.4
  take(&fast::draw);  // S9.4
  take(&ref::draw);  // S9.5
  take(&fast::draw);  // S9.5
  take(&ref::draw);  // S9.6
  take(&fast::draw);  // S9.6
  take(&ref::draw);  // S9.7
  take(&fast::draw);  // S9.7
  take(&ref::draw);  // S9.8
  take(&fast::draw);  // S9.8
  take(&make_clips);  // S10.1
  take(&ref::clipped);  // S10.2
  {  // S10.2
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  take(&ref::add_caps);  // S10.3
  {  // S10.3
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  take(&cap_color);  // S10.4
  take(&cap_color_at_sample);  // S10.4
  take(&ref::render_area);  // S10.5
  take(&ref::section_map);  // S10.5
  take(&fast::render_area);  // S10.5
  take(&fast::section_map);  // S10.5
  take(&connected_parts);  // S10.6
  take(&are_parts_closed);  // S10.6
  take(&told_apart);  // S10.6
  take(&cap_color_at_sample);  // S10.6
  take(&ref::add_caps);  // S10.6
  {  // S10.6
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const RenderOptions&);
    take<Kind>(&fast::render);
  }
  take(&fast::section_map);  // S10.6
  take(&ref::blend);  // S10.7
  take(&ref::transparent_section);  // S10.7
  {  // S10.7
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, std::uint8_t, const RenderOptions&);
    take<Kind>(&fast::blend);
  }
  take(&fast::transparent_section);  // S10.7
  take(&make_scalars);  // S11.1
  take(&ref::scalar_at);  // S11.2
  {  // S11.2
    using namespace fast;
    using Kind = ColorImage(const Scene&, const Camera&, const ImageOptions&, const ItemImage&, const ScalarColors&, const ScalarOptions&);
    take<Kind>(&fast::color_scalars);
  }
  take(&ref::color_of);  // S11.3
  take(&fast::prepare_scalars);  // S11.3
  take(&ref::color_scalars);  // S11.4
  {  // S11.4
    using namespace ref;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const Look&, const ScalarField&, const ColorScale&);
    take<Kind>(&ref::render_look);
  }
  {  // S11.4
    using namespace fast;
    using Kind = ColorImage(const Scene&, const Camera&, const ImageOptions&, const ItemImage&, const ScalarColors&, const ScalarOptions&);
    take<Kind>(&fast::color_scalars);
  }
  {  // S11.4
    using namespace fast;
    using Kind = Rendering(const Scene&, const BspTree&, const Camera&, const ImageOptions&, const Look&, const RenderOptions&, const ScalarColors*);
    take<Kind>(&fast::render_look);
  }
  take(&with_line);  // S14.1
  take(&ref::is_on_line);  // S14.2
  take(&fast::add_lines);  // S14.2
  take(&ref::add_lines);  // S14.3
  take(&fast::add_lines);  // S14.3
  take(&make_assembly);  // S12.1
  take(&hull_region);  // S12.1
  take(&share_space);  // S12.1
  take(&make_placement);  // S12.2
  take(&ref::moved_polygons);  // S12.2
  take(&fast::render_moving);  // S12.2
  take(&make_placement);  // S12.3
  take(&ref::check_free);  // S12.4
  take(&ref::moved_polygons);  // S12.4
  take(&fast::build_moving_trees);  // S12.4
  take(&ref::render_moving);  // S12.5
  take(&fast::render_moving);  // S12.5
  take(&fast::build_moving_trees);  // S12.6
  take(&fast::build_model_tree);  // S12.6
  take(&fast::render_moving);  // S12.6
  take(&ref::flat_scene);  // S12.7
  take(&flat_options);  // S12.7
  take(&flat_camera);  // S12.7
  take(&fast::flat_scene);  // S12.7
}

}  // namespace
}  // namespace halfspace

int main() {
  halfspace::take_all();
  std::printf("%zu functions\n", halfspace::taken);
  return halfspace::taken == 215 ? 0 : 1;
}
