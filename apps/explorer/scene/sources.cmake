# The only folder that includes VTK; other folders include scene_view.h and scene_options_panel.h.
set(EMCA_SCENE_SOURCES
  scene/camera_driver.cpp scene/camera_driver.h
  scene/clip_plane.cpp scene/clip_plane.h
  scene/glyph_layer.cpp scene/glyph_layer.h
  scene/heat_layer.cpp scene/heat_layer.h
  scene/kept_renderer.cpp scene/kept_renderer.h
  scene/mesh_decimation.cpp scene/mesh_decimation.h
  scene/mesh_geometry.cpp scene/mesh_geometry.h
  scene/mesh_welding.cpp scene/mesh_welding.h
  scene/mesh_layer.cpp scene/mesh_layer.h
  scene/mesh_loader.cpp scene/mesh_loader.h
  scene/object_geometry.cpp scene/object_geometry.h
  scene/object_layer.cpp scene/object_layer.h
  scene/object_picker.cpp scene/object_picker.h
  scene/open_gl.cpp
  scene/path_coloring.cpp scene/path_coloring.h
  scene/path_geometry.cpp scene/path_geometry.h
  scene/path_layer.cpp scene/path_layer.h
  scene/place_table.h
  scene/picking.cpp scene/picking.h
  scene/ray_switches.h
  scene/scene_canvas.cpp scene/scene_canvas.h
  scene/scene_input.cpp scene/scene_input.h
  scene/scene_objects.cpp scene/scene_objects.h
  scene/scene_options.h
  scene/scene_options_panel.cpp scene/scene_options_panel.h
  scene/scene_overlay.cpp scene/scene_overlay.h
  scene/scene_panels.h scene/scene_color_panel.cpp scene/scene_ray_panel.cpp scene/scene_picture_panel.cpp
  scene/scene_picker.cpp scene/scene_picker.h
  scene/scene_view.cpp scene/scene_view.h scene/scene_view_camera.cpp scene/scene_view_impl.h scene/scene_view_menu.cpp scene/scene_view_models.cpp
  scene/scene_view_overlay.cpp scene/scene_view_picture.cpp scene/scene_view_pointer.cpp
  scene/scene_view_surface.cpp
  scene/stroke.h
  scene/stroke_layer.cpp scene/stroke_layer.h
  scene/stroke_mapper.cpp scene/stroke_mapper.h
  scene/surface_data.cpp scene/surface_data.h
  scene/surface_model.cpp scene/surface_model.h
  scene/surface_panel.cpp scene/surface_panel.h scene/surface_panel_list.cpp
  scene/surface_picker.cpp scene/surface_picker.h
  scene/surface_style.h
  scene/vertex_card.cpp scene/vertex_card.h
  scene/view_pose.cpp scene/view_pose.h)
set(EMCA_SCENE_TESTS scene/camera_driver_test.cpp scene/clip_plane_test.cpp scene/mesh_decimation_test.cpp scene/mesh_geometry_test.cpp
  scene/object_picker_test.cpp scene/path_coloring_test.cpp scene/path_geometry_test.cpp scene/picking_test.cpp
  scene/scene_objects_test.cpp scene/scene_test_data.cpp scene/scene_view_offscreen_test.cpp
  scene/surface_model_test.cpp scene/surface_panel_test.cpp scene/surface_test_data.h scene/view_pose_test.cpp)
set(EMCA_SCENE_GL_TESTS scene/scene_features_test.cpp scene/scene_pictures_test.cpp scene/scene_surface_test.cpp scene/scene_test_data.cpp scene/scene_view_for_tests.h scene/scene_view_test.cpp)
# A program of its own, for bench/: what a click costs. Links emca_explorer_scene.
set(EMCA_SCENE_BENCH scene/scene_bench.cpp scene/scene_test_data.cpp)
