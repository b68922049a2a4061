//! A host in Rust that knows nothing but plumb.rs: loads a backend, lets a cube fall on the ground for two seconds, and
//! prints where it rests. Status 3: the backend cannot do this, and says why.
use std::ffi::{CStr, CString};
use std::os::raw::{c_char, c_int, c_void};

#[path = "../plumb.rs"]
mod plumb;
use plumb::*;

extern "C" {
    fn dlopen(file: *const c_char, flags: c_int) -> *mut c_void; // LoadLibraryA and GetProcAddress on Windows
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}
const RTLD_NOW: c_int = 2;

unsafe fn check(result: PlumbResult, what: &str, text: *const c_char) {
    if result < 0 {
        eprintln!("{}: {}", what, CStr::from_ptr(text).to_string_lossy());
        std::process::exit(if result == PLUMB_E_UNSUPPORTED { 3 } else { 1 });
    }
}

unsafe fn fall(file: &str) -> Option<()> {
    let library = dlopen(CString::new(file).ok()?.as_ptr(), RTLD_NOW);
    assert!(!library.is_null(), "{file}: no library that can be loaded");
    let symbol = dlsym(library, PLUMB_OPEN_SYMBOL.as_ptr());
    let open: PlumbOpenFunction = std::mem::transmute(symbol);
    let request = PlumbOpenRequest { min_version: PLUMB_VERSION, max_version: PLUMB_VERSION, ..Default::default() };
    let mut reply = PlumbOpenReply::default();
    check(open?(&request, &mut reply), file, reply.message.as_ptr());
    let table = &*reply.table;
    let error = |world| table.error_text.expect("error_text")(world);

    let needs = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
    let gravity = PlumbVec3 { y: -9.81, ..Default::default() };
    let desc = PlumbWorldDesc { needs, gravity, ..Default::default() };
    let mut world = std::ptr::null_mut();
    check(table.create_world?(&desc, &mut world), "world", error(world));

    let cuboid = |half_extents| PlumbShapeDesc { r#type: PLUMB_BOX, half_extents, ..Default::default() };
    let descs = [cuboid(PlumbVec3 { x: 50.0, y: 0.5, z: 50.0 }), cuboid(PlumbVec3 { x: 0.5, y: 0.5, z: 0.5 })]; // m
    let mut shapes = [0; 2];
    let stride = std::mem::size_of::<PlumbShapeDesc>();
    check(table.create_shapes?(world, descs.as_ptr(), stride, 2, shapes.as_mut_ptr()), "shapes", error(world));

    let upright = PlumbQuat { w: 1.0, ..Default::default() };
    let body = |motion, shape, y| PlumbBodyDesc {
        motion,
        shape,
        pose: PlumbPose { position: PlumbVec3 { y, ..Default::default() }, orientation: upright },
        inertia_orientation: upright,
        density: 1000.0,
        gravity_scale: 1.0,
        material: PlumbMaterial { friction: 0.5, ..Default::default() },
        filter: PlumbFilter { category: 1, mask: u32::MAX, ..Default::default() },
        ..Default::default()
    };
    let descs = [body(PLUMB_STATIC, shapes[0], -0.5), body(PLUMB_DYNAMIC, shapes[1], 3.0)];
    let mut bodies = [0; 2];
    let stride = std::mem::size_of::<PlumbBodyDesc>();
    check(table.create_bodies?(world, descs.as_ptr(), stride, 2, bodies.as_mut_ptr()), "bodies", error(world));

    let step = PlumbStepDesc { dt: 1.0 / 60.0, ..Default::default() };
    for _ in 0..120 {
        check(table.step?(world, &step), "step", error(world));
        check(table.wait?(world, std::ptr::null_mut()), "wait", error(world));
    }
    let mut pose = [0.0; 7]; // position, orientation x y z w
    let row = pose.as_mut_ptr() as *mut c_void;
    let size = std::mem::size_of_val(&pose);
    check(table.read?(world, PLUMB_FIELD_POSE, PLUMB_F64, &bodies[1], 1, row, size), "read", error(world));
    let name = CStr::from_ptr((*table.info?()).name);
    println!("{}: the cube rests at {:.3} m", name.to_string_lossy(), pose[1]);
    table.destroy_world?(world);
    Some(())
}

fn main() {
    let file = std::env::args().nth(1).expect("usage: falling_cube BACKEND.so");
    unsafe { fall(&file) }.expect("no Plumb backend, or one that lacks a function");
}
