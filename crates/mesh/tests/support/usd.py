"""Opens a USD file, runs every validator on it, prints its corners and triangles; 1 if something is wrong."""

import sys

from pxr import Usd, UsdGeom, UsdValidation

stage = Usd.Stage.Open(sys.argv[1])
validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
wrong = UsdValidation.ValidationContext(validators).Validate(stage)
corners = triangles = 0
for prim in stage.Traverse():
    if prim.IsA(UsdGeom.Mesh):
        mesh = UsdGeom.Mesh(prim)
        counts, indices = mesh.GetFaceVertexCountsAttr().Get(), mesh.GetFaceVertexIndicesAttr().Get()
        points = len(mesh.GetPointsAttr().Get())
        fine, why = UsdGeom.Mesh.ValidateTopology(indices, counts, points)
        if not fine:
            sys.exit(why)
        corners, triangles = corners + points, triangles + len(counts)
for error in wrong:
    print(error.GetName(), error.GetMessage())
print(corners, triangles)
sys.exit(1 if wrong else 0)
