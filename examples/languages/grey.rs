// A renderer in Rust with EMCA's calls in it, small enough to show the declarations. docs/c-api.md
//
//     rustc --edition 2021 -O grey.rs -L native=… -l emca
#![allow(non_camel_case_types)]
use std::ffi::{c_char, c_void, CStr};
use std::mem::size_of;
use std::ptr::{addr_of_mut, null, null_mut};

#[repr(C)] #[derive(Clone, Copy)] pub struct emca_pixel { x: u32, y: u32 }
#[repr(C)] #[derive(Clone, Copy)] pub struct emca_vec3f { x: f32, y: f32, z: f32 }
#[repr(C)] #[derive(Clone, Copy)] pub struct emca_color { r: f32, g: f32, b: f32 }
#[repr(C)] pub struct emca_error { code: i32, message: [c_char; 508] }
#[repr(C)] pub struct emca_key { text: *const c_char, file: *const c_char, line: u32, length: u32, hash: u64 }
#[repr(C)] pub struct emca_settings {
    size: u32, version: u32, samples_per_pixel: u32, has_seed: i32, seed: u64,
    integrator: *const c_char, sampler: *const c_char,
}
#[repr(C)] pub struct emca_image {
    size: u32, version: u32, width: u32, height: u32,
    color: *mut emca_color, samples: *mut f32, variance: *mut emca_color, has_samples: i32, has_variance: i32,
}
#[repr(C)] pub struct emca_info {
    size: u32, version: u32, renderer: *const c_char, scene: *const c_char, integrator: *const c_char,
    sampler: *const c_char, seed: u64, width: u32, height: u32, samples_per_pixel: u32, threads: u32, concurrent: i32,
    deterministic: i32, paths_reach_any_pixel: i32, capability_count: u32, capabilities: *const *const c_char,
}
/// Up to the functions that every renderer has: the library takes a struct that ends here as it is.
#[repr(C)] pub struct emca_renderer {
    size: u32, version: u32, user: *mut c_void,
    info: extern "C" fn(*mut c_void, *mut emca_info, *mut emca_error) -> i32,
    camera: extern "C" fn(*mut c_void, *mut c_void, *mut emca_error) -> i32,
    meshes: extern "C" fn(*mut c_void, *mut c_void, *mut emca_error) -> i32,
    render_image: extern "C" fn(*mut c_void, *const emca_settings, *mut c_void, *mut emca_image, *mut emca_error) -> i32,
    render_pixel: extern "C" fn(*mut c_void, emca_pixel, *const emca_settings, *mut c_void, *mut c_void,
                                *mut emca_color, *mut emca_error) -> i32,
}
#[repr(C)] pub struct emca_server_options {
    size: u32, version: u32, host: *const c_char, token: *const c_char, port: u16, reserved: u16, allow_quit: i32,
}

#[link(name = "emca")]
extern "C" {
    fn emca_seed(master_seed: u64, pixel: emca_pixel, sample: u64) -> u64;
    fn emca_thread_recorder() -> *mut c_void;
    fn emca_set_path_index(recorder: *mut c_void, sample: i64, part: i32);
    fn emca_set_depth_index(recorder: *mut c_void, depth: i32, subpath: i32);
    fn emca_set_intersection_pos(recorder: *mut c_void, position: emca_vec3f);
    fn emca_add_intersection_float(recorder: *mut c_void, key: *mut emca_key, value: f32);
    fn emca_set_final_estimate(recorder: *mut c_void, estimate: emca_color);
    fn emca_server_start(renderer: *const emca_renderer, options: *const emca_server_options, server: *mut *mut c_void,
                         error: *mut emca_error) -> i32;
    fn emca_server_address(server: *const c_void) -> *const c_char;
    fn emca_server_wait(server: *mut c_void);
    fn emca_server_destroy(server: *mut c_void);
}
const ABI: u32 = 1 << 16;  // the version that these declarations are of: EMCA_ABI

static mut VALUE: emca_key = emca_key { text: c"value".as_ptr(), file: null(), line: 0, length: 0, hash: 0 };

unsafe fn shade(pixel: emca_pixel, settings: &emca_settings) -> emca_color {
    let emca = emca_thread_recorder();
    let mut sum = 0.0;
    for sample in 0..settings.samples_per_pixel {
        let value = (emca_seed(settings.seed, pixel, sample as u64) & 0xffff) as f32 / 65536.0;
        if !emca.is_null() {  // what `static inline` does in C
            emca_set_path_index(emca, sample as i64, 0);
            emca_set_depth_index(emca, 1, 0);
            emca_set_intersection_pos(emca, emca_vec3f { x: pixel.x as f32, y: pixel.y as f32, z: 0.0 });
            emca_add_intersection_float(emca, addr_of_mut!(VALUE), value);
            emca_set_final_estimate(emca, emca_color { r: value, g: value, b: value });
        }
        sum += value;
    }
    let mean = sum / settings.samples_per_pixel as f32;
    emca_color { r: mean, g: mean, b: mean }
}

extern "C" fn info(_: *mut c_void, info: *mut emca_info, _: *mut emca_error) -> i32 {
    let info = unsafe { &mut *info };
    info.renderer = c"grey in Rust".as_ptr();
    info.scene = c"noise".as_ptr();
    (info.width, info.height, info.samples_per_pixel) = (4, 3, 2);
    0
}
extern "C" fn as_usual(_: *mut c_void, _: *mut c_void, _: *mut emca_error) -> i32 { 0 }
extern "C" fn render_image(_: *mut c_void, settings: *const emca_settings, _: *mut c_void, image: *mut emca_image,
                           _: *mut emca_error) -> i32 {
    let image = unsafe { &mut *image };
    for y in 0..image.height {
        for x in 0..image.width {
            unsafe { *image.color.add((y * image.width + x) as usize) = shade(emca_pixel { x, y }, &*settings) }
        }
    }
    0
}
extern "C" fn render_pixel(_: *mut c_void, pixel: emca_pixel, settings: *const emca_settings, _: *mut c_void,
                           _: *mut c_void, value: *mut emca_color, _: *mut emca_error) -> i32 {
    unsafe { *value = shade(pixel, &*settings) }
    0
}

fn main() {
    let renderer = emca_renderer { size: size_of::<emca_renderer>() as u32, version: ABI, user: null_mut(), info,
                                   camera: as_usual, meshes: as_usual, render_image, render_pixel };
    let options = emca_server_options { size: size_of::<emca_server_options>() as u32, version: ABI, host: null(),
                                        token: null(), port: 0, reserved: 0, allow_quit: 1 };
    let mut error = emca_error { code: 0, message: [0; 508] };
    let mut server = null_mut();
    unsafe {
        if emca_server_start(&renderer, &options, &mut server, &mut error) != 0 {
            panic!("{}", CStr::from_ptr(error.message.as_ptr()).to_string_lossy());
        }
        println!("listening on {}", CStr::from_ptr(emca_server_address(server)).to_string_lossy());
        emca_server_wait(server);
        emca_server_destroy(server);
    }
}
