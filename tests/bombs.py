"""Small files whose content needs gigabytes, in the formats of tables, maps and force curves."""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterable
from pathlib import Path

import h5py
import netCDF4
import numpy as np

_SHEET = "xl/worksheets/sheet1.xml"
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_TABLE = '<row r="1"><c r="A1"><v>1</v></c></row>'


def zipped(path: Path, parts: Iterable[tuple[str, str | bytes]]) -> None:
    """Write a zip file of these parts."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        for name, content in parts:
            package.writestr(name, content)


def deflated(byte: bytes, megabytes: int) -> bytes:
    """Return a deflated stream (RFC 1951) of one byte repeated, at a thousandth of its size."""
    packer = zlib.compressobj(wbits=-15)
    block = packer.compress(byte * 2**20) + packer.flush(zlib.Z_FULL_FLUSH)
    return block * megabytes + packer.flush()


def add_large(path: Path, name: str, head: bytes, byte: bytes, megabytes: int) -> None:
    """Add a part to a zip file: a head, then one byte repeated, without a true checksum."""
    packer = zlib.compressobj(wbits=-15)
    stream = packer.compress(head) + packer.flush(zlib.Z_FULL_FLUSH) + deflated(byte, megabytes)
    size = len(head) + megabytes * 2**20
    with zipfile.ZipFile(path, "a", zipfile.ZIP_STORED) as package:
        place = zipfile.ZipInfo(name)
        package.writestr(place, stream)
        place.compress_type, place.file_size = zipfile.ZIP_DEFLATED, size
    # The local header of the part, which was written before.
    with path.open("r+b") as file:
        file.seek(place.header_offset + 8)
        file.write(struct.pack("<H", zipfile.ZIP_DEFLATED))
        file.seek(place.header_offset + 22)
        file.write(struct.pack("<L", min(size, 0xFFFFFFFF)))


def workbook(path: Path, sheet: str, place: str = _SHEET) -> Path:
    """Write an XLSX workbook of one sheet with this XML."""
    package = "http://schemas.openxmlformats.org/package/2006"
    office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    kind = "application/vnd.openxmlformats-officedocument.spreadsheetml"
    zipped(
        path,
        [
            (
                "[Content_Types].xml",
                f'<Types xmlns="{package}/content-types"><Override PartName="/xl/workbook.xml" '
                f'ContentType="{kind}.sheet.main+xml"/></Types>',
            ),
            (
                "_rels/.rels",
                f'<Relationships xmlns="{package}/relationships"><Relationship Id="rId1" '
                f'Type="{office}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
            ),
            (
                "xl/workbook.xml",
                f'<workbook xmlns="{_MAIN}" xmlns:r="{office}"><sheets>'
                '<sheet name="A" sheetId="1" r:id="rId1"/></sheets></workbook>',
            ),
            (
                "xl/_rels/workbook.xml.rels",
                f'<Relationships xmlns="{package}/relationships"><Relationship Id="rId1" '
                f'Type="{office}/worksheet" Target="/{place}"/></Relationships>',
            ),
            (place, sheet),
        ],
    )
    return path


def _sheet(rows: str, before: str = "") -> str:
    return f'<worksheet xmlns="{_MAIN}">{before}<sheetData>{rows}</sheetData></worksheet>'


def _far(cell: str, row: int) -> str:
    return f'<row r="{row}"><c r="{cell}"><v>1</v></c></row>'


_LAST = _far("XFD1048576", 1048576)
_QUOTED = _sheet(_TABLE + _LAST).replace('"', "'")
_PREFIXED = (
    f'<x:worksheet xmlns:x="{_MAIN}"><x:sheetData><x:row r="1"><x:c r="A1"><x:v>1</x:v></x:c>'
    '</x:row><x:row r="1048576"><x:c r="XFD1048576"><x:v>1</x:v></x:c></x:row></x:sheetData>'
    "</x:worksheet>"
)

#: Workbooks, by what is in them.
WORKBOOKS: dict[str, Callable[[Path], Path]] = {
    "no dimension.xlsx": lambda path: workbook(path, _sheet(_TABLE + _LAST)),
    "false dimension.xlsx": lambda path: workbook(
        path, _sheet(_TABLE + _LAST, '<dimension ref="A1:B2"/>')
    ),
    "late dimension.xlsx": lambda path: workbook(
        path, _sheet(_TABLE + _LAST, f'<!--{"-x" * 5000}--><dimension ref="A1:XFD1048576"/>')
    ),
    "200000 rows.xlsx": lambda path: workbook(path, _sheet(_TABLE + _far("ALL200000", 200000))),
    "true dimension.xlsx": lambda path: workbook(
        path, _sheet(_TABLE + _far("ZZ70000", 70000), '<dimension ref="A1:ZZ70000"/>')
    ),
    "single quotes.xlsx": lambda path: workbook(path, _QUOTED),
    "prefix.xlsx": lambda path: workbook(path, _PREFIXED),
    "elsewhere.xlsx": lambda path: workbook(path, _sheet(_TABLE + _LAST), "data/a.xml"),
    "out of order.xlsx": lambda path: workbook(path, _sheet(_LAST + _TABLE)),
    "long text.xlsx": lambda path: _long_text(path),
    "rows repeated.ods": lambda path: open_document(path, rows=1_500_000_000),
    "columns repeated.ods": lambda path: open_document(path, columns=1_500_000_000),
    "cells repeated.ods": lambda path: open_document(path, rows=1_000_000, columns=1000),
}


def _long_text(path: Path) -> Path:
    with zipfile.ZipFile(workbook(path, _sheet(_TABLE))) as package:
        parts = [(name, package.read(name)) for name in package.namelist() if name != _SHEET]
    zipped(path, parts)
    head = f'<worksheet xmlns="{_MAIN}"><sheetData><row><c t="str"><v>'
    add_large(path, _SHEET, head.encode(), b"a", 3000)
    return path


def open_document(path: Path, rows: int = 1, columns: int = 1) -> Path:
    """Write an ODS workbook of cells that are repeated."""
    spaces = "".join(
        f' xmlns:{each}="urn:oasis:names:tc:opendocument:xmlns:{each}:1.0"'
        for each in ("office", "table", "text")
    )
    kind = "application/vnd.oasis.opendocument.spreadsheet"
    content = (
        f"<office:document-content{spaces}><office:body><office:spreadsheet>"
        f'<table:table table:name="A"><table:table-row table:number-rows-repeated="{rows}">'
        f'<table:table-cell office:value-type="float" office:value="1" '
        f'table:number-columns-repeated="{columns}"/></table:table-row></table:table>'
        "</office:spreadsheet></office:body></office:document-content>"
    )
    manifest = (
        '<manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0">'
        f'<manifest:file-entry manifest:full-path="/" manifest:media-type="{kind}"/>'
        "</manifest:manifest>"
    )
    zipped(
        path,
        [("mimetype", kind), ("content.xml", content), ("META-INF/manifest.xml", manifest)],
    )
    return path


def _array_head(shape: tuple[int, ...]) -> bytes:
    head = io.BytesIO()
    layout = {"descr": "<f8", "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(head, layout)
    return head.getvalue()


def _npz(path: Path) -> Path:
    add_large(path, "height.npy", _array_head((25000, 25000)), b"\0", 5000)
    return path


def _npy(path: Path) -> Path:
    path.write_bytes(_array_head((10**6, 10**6)) + bytes(100))
    return path


def _x3p(path: Path) -> Path:
    axes = "".join(
        f"<C{a}><AxisType>{kind}</AxisType><DataType>D</DataType><Increment>1e-6</Increment>"
        f"<Offset>0</Offset></C{a}>"
        for a, kind in (("X", "I"), ("Y", "I"), ("Z", "A"))
    )
    head = (
        '<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1><Revision>'
        "ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>"
        f"{axes}</Axes></Record1><Record2><Date>2026-01-01T00:00:00</Date></Record2><Record3>"
        "<MatrixDimension><SizeX>25000</SizeX><SizeY>25000</SizeY><SizeZ>1</SizeZ>"
        "</MatrixDimension><DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink>"
        "</Record3></p:ISO5436_2>"
    )
    zipped(path, [("main.xml", head)])
    add_large(path, "bindata/data.bin", b"", b"\0", 4769)
    return path


def _hdf5(path: Path) -> Path:
    with h5py.File(path, "w") as file:
        file.create_dataset("map", (10**5, 10**5), "f8", chunks=(1000, 1000), compression="gzip")
    return path


def _hdf5_chunk(path: Path) -> Path:
    """Chunk that is packed in two passes, of which the inner one needs terabytes."""
    with h5py.File(path, "w") as file:
        layout = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        layout.set_chunk((64, 64))
        layout.set_deflate(9)
        layout.set_deflate(9)
        space = h5py.h5s.create_simple((64, 64))
        data = h5py.h5d.create(file.id, b"map", h5py.h5t.IEEE_F64LE, space, layout)
        inner = b"\x78\x9c" + deflated(b"\0", 4000) + bytes(4)
        data.write_direct_chunk((0, 0), zlib.compress(inner, 9))
    return path


def _matlab(path: Path) -> Path:
    n = 25000
    flags = struct.pack("<IIII", 6, 8, 6, 0)
    size = struct.pack("<IIii", 5, 8, n, n)
    name = struct.pack("<IHH", 0x00030001, 0, 0)[:0] + struct.pack("<HHI", 1, 1, ord("z"))
    head = flags + size + name + struct.pack("<II", 9, 8 * n * n % 2**32)
    element = struct.pack("<II", 14, (len(head) + 8 * n * n) % 2**32) + head
    packer = zlib.compressobj(wbits=-15)
    stream = packer.compress(element) + packer.flush(zlib.Z_FULL_FLUSH) + deflated(b"\0", 4769)
    stream = b"\x78\x9c" + stream
    start = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM"
    path.write_bytes(start + struct.pack("<II", 15, len(stream)) + stream)
    return path


def _netcdf(path: Path) -> Path:
    """File of fill values alone."""
    with netCDF4.Dataset(str(path), "w") as file:
        for axis in "xy":
            file.createDimension(axis, 10**5)
        file.createVariable("heights", "f8", ("x", "y"), zlib=True)
    return path


def _netcdf3(path: Path) -> Path:
    """Classic file (version 2) whose header states a map of 8 TB."""

    def text(name: str) -> bytes:
        return struct.pack(">I", len(name)) + name.encode().ljust(-(-len(name) // 4) * 4, b"\0")

    size = struct.pack(">I", 10**6)
    head = b"CDF\x02" + struct.pack(">III", 0, 10, 2) + text("x") + size + text("y") + size
    head += struct.pack(">IIII", 0, 0, 11, 1) + text("heights") + struct.pack(">III", 2, 0, 1)
    head += struct.pack(">IIII", 0, 0, 6, 0xFFFFFFFF)
    path.write_bytes(head + struct.pack(">Q", len(head) + 8) + bytes(64))
    return path


#: Maps of heights.
MAPS: dict[str, Callable[[Path], Path]] = {
    "zeros.npz": _npz,
    "header.npy": _npy,
    "zeros.x3p": _x3p,
    "fills.h5": _hdf5,
    "chunk.h5": _hdf5_chunk,
    "zeros.mat": _matlab,
    "fills.nc": _netcdf,
    "header.nc": _netcdf3,
}


def _jpk(path: Path) -> Path:
    cell = Path(__file__).parent / "identification" / "cell.jpk-force"
    with zipfile.ZipFile(cell) as package:
        parts = [(name, package.read(name)) for name in package.namelist()]
    zipped(path, [each for each in parts if each[0] != "header.properties"])
    add_large(path, "header.properties", dict(parts)["header.properties"], b"#", 3000)
    return path


def _curve(path: Path) -> Path:
    with h5py.File(path, "w") as file:
        file.attrs.update({"software": "afmformats", "software version": "0.18.7"})
        curve = file.create_group("0")
        curve.attrs.update({"spring constant": 0.1, "imaging mode": "force-distance"})
        for name in ("time", "force", "height (piezo)"):
            curve.create_dataset(name, (10**10,), "f8", chunks=(10**6,), compression="gzip")
    return path


#: Force curves.
CURVES: dict[str, Callable[[Path], Path]] = {"header.jpk-force": _jpk, "fills.h5": _curve}


def result(path: Path, time: int, points: int) -> Path:
    """Write a result of so many instants, and of so many points along both axes, without values."""
    with netCDF4.Dataset(str(path), "w") as file:
        for name, length in (("time", time), ("x", points), ("y", points)):
            file.createDimension(name, length)
            file.createVariable(name, "f8", (name,), zlib=True)
        file.createVariable("pressure", "f4", ("time", "x", "y"), zlib=True)
    return path
