"""Blender files of one mesh, with no more in them than Assimp's reader asks for: it goes by the table of structures (SDNA) inside."""

import struct

# Structures in the order of their indices; fields as (type, name).
STRUCTURES = {
    "ID": (("char", "name[24]"),),
    "ListBase": (("void", "*first"), ("void", "*last")),
    "Base": (("Base", "*next"), ("Base", "*prev"), ("Object", "*object")),
    "Object": (("ID", "id"), ("int", "type"), ("float", "obmat[4][4]"), ("Object", "*parent"), ("void", "*data")),
    "Mesh": (("ID", "id"), ("int", "totface"), ("int", "totedge"), ("int", "totvert"), ("MFace", "*mface"),
             ("MVert", "*mvert"), ("Material", "**mat")),
    "MVert": (("float", "co[3]"), ("float", "no[3]")),
    "MFace": (("int", "v1"), ("int", "v2"), ("int", "v3"), ("int", "v4"), ("int", "mat_nr")),
    "Scene": (("ID", "id"), ("ListBase", "base")),
}
PLAIN = {"char": 1, "int": 4, "float": 4, "void": 0, "Material": 0}
IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
SCENE, BASE, OBJECT, MESH, VERTICES, FACES = range(1, 7)  # places that pointers name


def table():
    types = [*PLAIN, *STRUCTURES]
    names = sorted({name for fields in STRUCTURES.values() for _, name in fields})

    def padded(text):
        return text + bytes(-len(text) % 4)

    def words(texts):
        return struct.pack("<i", len(texts)) + b"".join(text.encode() + b"\0" for text in texts)

    fields = b"".join(
        struct.pack("<hh", types.index(kind), len(of)) +
        b"".join(struct.pack("<hh", types.index(field), names.index(name)) for field, name in of)
        for kind, of in STRUCTURES.items())
    # Sizes count only of structures that lie in others.
    sizes = struct.pack(f"<{len(types)}h", *({"ID": 24, "ListBase": 16, **PLAIN}.get(kind, 0) for kind in types))
    return (b"SDNANAME" + padded(words(names)) + b"TYPE" + padded(words(types)) + b"TLEN" + padded(sizes) + b"STRC" +
            struct.pack("<i", len(STRUCTURES)) + fields)


def blend_file(vertices, triangles):
    """Its bytes; without triangles a scene that nothing is in."""

    def block(kind, place, content, count=1):
        index = list(STRUCTURES).index(kind)
        return struct.pack("<4siQii", b"DATA", len(content), place, index, count) + content

    base = BASE if triangles else 0
    blocks = (
        block("Scene", SCENE, struct.pack("<24sQQ", b"SCScene", base, base)),
        block("Base", BASE, struct.pack("<QQQ", 0, 0, OBJECT)),
        block("Object", OBJECT, struct.pack("<24si16fQQ", b"OBbody", 1, *IDENTITY, 0, MESH)),
        block("Mesh", MESH, struct.pack("<24siiiQQQ", b"MEbody", len(triangles), 0, len(vertices), FACES, VERTICES, 0)),
        block("MVert", VERTICES, b"".join(struct.pack("<6f", *v, 0, 0, 1) for v in vertices), len(vertices)),
        block("MFace", FACES, b"".join(struct.pack("<5i", *t, 0, 0) for t in triangles), len(triangles)),
    )
    sdna = table()
    return (b"BLENDER-v248" + b"".join(blocks) + struct.pack("<4siQii", b"DNA1", len(sdna), 99, 0, 1) + sdna +
            struct.pack("<4siQii", b"ENDB", 0, 0, 0, 0))
