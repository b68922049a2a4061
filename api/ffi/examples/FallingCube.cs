// A host in C# that knows nothing but Plumb.cs: loads a backend, lets a cube fall on the ground for two seconds, and
// prints where it rests. Status 3: the backend cannot do this, and says why.
using System;
using System.Runtime.InteropServices;
using Plumb.Ffi;
using static Plumb.Ffi.Constants;
using Table = Plumb.Ffi.PlumbBackendTable;

public static unsafe class FallingCube
{
    [DllImport("libdl.so.2")]  // NativeLibrary.Load and GetExport on .NET; LoadLibrary and GetProcAddress on Windows
    private static extern IntPtr dlopen(string file, int flags);
    [DllImport("libdl.so.2")]
    private static extern IntPtr dlsym(IntPtr library, string name);
    private const int RTLD_NOW = 2;

    private static void Check(int result, string what, byte* text)
    {
        if (result >= 0) return;
        Console.Error.WriteLine($"{what}: {Calls.Text(text)}");
        Environment.Exit(result == PLUMB_E_UNSUPPORTED ? 3 : 1);
    }

    private static PlumbShapeDesc Box(double x, double y, double z)
    {
        return new PlumbShapeDesc { struct_size = (uint)sizeof(PlumbShapeDesc), type = PLUMB_BOX,
                                    half_extents = new PlumbVec3 { x = x, y = y, z = z } };
    }

    private static PlumbBodyDesc Body(uint motion, ulong shape, double y)
    {
        var desc = new PlumbBodyDesc { struct_size = (uint)sizeof(PlumbBodyDesc), motion = motion, shape = shape,
                                       density = 1000, gravity_scale = 1 };
        desc.pose.position.y = y;
        desc.pose.orientation.w = desc.inertia_orientation.w = 1;
        desc.material.friction = 0.5;
        desc.filter = new PlumbFilter { category = 1, mask = uint.MaxValue };
        return desc;
    }

    public static void Main(string[] arguments)
    {
        if (arguments.Length != 1) throw new ArgumentException("usage: FallingCube BACKEND.so");
        IntPtr library = dlopen(arguments[0], RTLD_NOW);
        if (library == IntPtr.Zero) throw new DllNotFoundException(arguments[0]);
        var open = Calls.Function<PlumbOpenFunction>(dlsym(library, PLUMB_OPEN_SYMBOL));
        if (open == null) throw new EntryPointNotFoundException($"{arguments[0]}: no Plumb backend");
        var request = new PlumbOpenRequest { struct_size = (uint)sizeof(PlumbOpenRequest), min_version = PLUMB_VERSION,
                                             max_version = PLUMB_VERSION };
        var reply = new PlumbOpenReply { struct_size = (uint)sizeof(PlumbOpenReply) };
        Check(open(&request, &reply), arguments[0], reply.message);
        Table* table = reply.table;
        var errorText = Calls.Function<Table.ErrorText>(table->error_text);

        var worldDesc = new PlumbWorldDesc { struct_size = (uint)sizeof(PlumbWorldDesc),
                                             needs = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION };
        worldDesc.gravity.y = -9.81;
        PlumbWorld* world = null;
        var createWorld = Calls.Function<Table.CreateWorld>(table->create_world);
        Check(createWorld(&worldDesc, &world), "world", errorText(world));

        PlumbShapeDesc* shapes = stackalloc PlumbShapeDesc[2];
        shapes[0] = Box(50, 0.5, 50);  // m
        shapes[1] = Box(0.5, 0.5, 0.5);
        ulong* ids = stackalloc ulong[2];
        var createShapes = Calls.Function<Table.CreateShapes>(table->create_shapes);
        Check(createShapes(world, shapes, (UIntPtr)sizeof(PlumbShapeDesc), 2, ids), "shapes", errorText(world));

        PlumbBodyDesc* bodies = stackalloc PlumbBodyDesc[2];
        bodies[0] = Body(PLUMB_STATIC, ids[0], -0.5);
        bodies[1] = Body(PLUMB_DYNAMIC, ids[1], 3);
        var createBodies = Calls.Function<Table.CreateBodies>(table->create_bodies);
        Check(createBodies(world, bodies, (UIntPtr)sizeof(PlumbBodyDesc), 2, ids), "bodies", errorText(world));

        var stepDesc = new PlumbStepDesc { struct_size = (uint)sizeof(PlumbStepDesc), dt = 1.0 / 60 };
        var step = Calls.Function<Table.Step>(table->step);
        var wait = Calls.Function<Table.Wait>(table->wait);
        for (int i = 0; i < 120; ++i)
        {
            Check(step(world, &stepDesc), "step", errorText(world));
            Check(wait(world, null), "wait", errorText(world));
        }
        double* pose = stackalloc double[7];  // position, orientation x y z w
        var read = Calls.Function<Table.Read>(table->read);
        int result = read(world, PLUMB_FIELD_POSE, PLUMB_F64, &ids[1], 1, pose, (UIntPtr)(7 * sizeof(double)));
        Check(result, "read", errorText(world));
        string name = Calls.Text(Calls.Function<Table.Info>(table->info)()->name);
        Console.WriteLine($"{name}: the cube rests at {pose[1]:F3} m");
        Calls.Function<Table.DestroyWorld>(table->destroy_world)(world);
    }
}
