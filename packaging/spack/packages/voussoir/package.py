# SPDX-License-Identifier: GPL-3.0-or-later
"""Spack recipe. Use: spack repo add packaging/spack; spack dev-build -d . voussoir@main
Without FCLib, which Spack does not have and the program does not need."""

from spack.package import *  # noqa: F403

try:  # Spack 1.0 and later
    from spack_repo.builtin.build_systems.cmake import CMakePackage, generator
except ImportError:
    from spack.package import CMakePackage, generator


class Voussoir(CMakePackage):
    """Earthquake analysis of concrete arch dams whose contraction joints open, close and slide."""

    license("GPL-3.0-or-later")  # noqa: F405

    version("main")  # noqa: F405

    variant("mpi", default=True, description="Runs with more than one process")  # noqa: F405
    variant("trilinos", default=False, description="Coarse solver of the rock's static state by Trilinos' ML")  # noqa: F405
    variant("arpack", default=True, description="Natural frequencies and mode shapes")  # noqa: F405

    depends_on("c", type="build")  # noqa: F405
    depends_on("cxx", type="build")  # noqa: F405
    depends_on("cmake@3.18:", type="build")  # noqa: F405
    depends_on("dealii@9.4:")  # noqa: F405
    depends_on("dealii+mpi", when="+mpi")  # noqa: F405
    depends_on("dealii+mpi+arpack", when="+arpack")  # noqa: F405
    depends_on("dealii+mpi+trilinos", when="+trilinos")  # noqa: F405
    depends_on("trilinos@:16", when="+trilinos")  # noqa: F405
    depends_on("suite-sparse")  # noqa: F405
    depends_on("openblas")  # noqa: F405
    depends_on("gmsh")  # noqa: F405
    depends_on("python@3.9:", type=("build", "run"))  # noqa: F405
    depends_on("py-matplotlib", type="run")  # noqa: F405
    requires("target=x86_64:", msg="The kernels of the dense products are for x86-64.")  # noqa: F405

    generator("ninja")
    build_targets = ["voussoir"]

    def cmake_args(self):
        features = [self.define_from_variant(f"VOUSSOIR_WITH_{name.upper()}", name) for name in ("mpi", "trilinos", "arpack")]
        return features + [self.define("VOUSSOIR_WITH_FCLIB", False), self.define("VOUSSOIR_UNITY", True)]
