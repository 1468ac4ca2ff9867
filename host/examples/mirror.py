"""A rough mirror under a white sky, on an OpenCL device, from Python with PyOpenCL: which part of the light does it
send on? And the same samples by NumPy alone. Exit status 0 if it is the known part, and both have the same bits.

    pip install ./host/python pyopencl; python mirror.py
"""
import sys

import clvndf
import numpy
import pyopencl
import pyopencl.array
import pyopencl.cltypes

# The mean of these weights, brdf * cos(theta) / density, is the answer. alpha.y = ratio * alpha.x: of two alphas that
# look alike PoCL makes a kernel that is many times slower.
KERNEL = """
kernel void sample(float3 wo, float alpha_x, float ratio, global const float* u1, global const float* u2,
                   global float* weight) {
    const size_t i = get_global_id(0);
    const float2 alpha = (float2)(alpha_x, ratio * alpha_x);
    const float3 wi = vndf_reflect(wo, vndf_ggx_sample_wm_dupuy2023(wo, alpha, (float2)(u1[i], u2[i])));
    weight[i] = wi.z > 0.0f ? vndf_ggx_weight(wo, wi, alpha) : 0.0f;
}
"""

wo, alpha = (0.6, 0.0, 0.8), (0.5, 0.1)  # towards the viewer, z along the normal; roughness along x and y
side = (numpy.arange(1024, dtype=numpy.float32) + numpy.float32(0.5)) / 1024
u = numpy.stack(numpy.meshgrid(side, side), axis=-1).reshape(-1, 2)

context = pyopencl.create_some_context(interactive=False)
queue = pyopencl.CommandQueue(context)
program = pyopencl.Program(context, clvndf.text() + KERNEL).build(clvndf.options(context.devices[0]))
u1, u2 = (pyopencl.array.to_device(queue, numpy.ascontiguousarray(u[:, i])) for i in range(2))
weight = pyopencl.array.empty_like(u1)
program.sample(queue, u1.shape, None, pyopencl.cltypes.make_float3(*wo), numpy.float32(alpha[0]),
               numpy.float32(alpha[1] / alpha[0]), u1.data, u2.data, weight.data)
weight = weight.get()

wi = clvndf.reflect(wo, clvndf.ggx_sample_wm_dupuy2023(wo, alpha, u))
same = numpy.where(wi[:, 2] > 0, clvndf.ggx_weight(wo, wi, alpha), numpy.float32(0))

reflected = weight.mean(dtype=float)
different = numpy.count_nonzero(weight.view("u4") != same.view("u4"))
print(f"reflected: {reflected:.4f} of the light; {different} of {weight.size} weights differ between device and NumPy")
sys.exit(not (abs(reflected - 0.80472) < 1e-4 and different == 0))
