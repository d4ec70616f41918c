//! CSV output of benchmark rows.

use super::Row;

/// Returns a header line and one line per row.
///
/// # Errors
/// Cannot occur when writing to memory.
pub fn csv(rows: &[Row]) -> Result<String, ::csv::Error> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let parts = |name: &str| ["", "_lo", "_hi"].map(|end| format!("{name}{end}"));
    let mut header: Vec<String> = [
        "scene",
        "estimator",
        "repeats",
        "threads",
        "spp",
        "wall_seconds",
        "cpu_seconds",
        "paths_per_second",
        "lookups_per_path",
        "lost",
    ]
    .map(str::to_owned)
    .to_vec();
    for name in ["relmse", "efficiency", "lookups_to_unit_error", "speedup"] {
        header.extend(parts(name));
    }
    header.extend(["heavy_tailed".to_owned(), "reference".to_owned()]);
    writer.write_record(&header)?;
    for row in rows {
        let mut fields = vec![
            row.scene.clone(),
            row.estimator.clone(),
            row.repeats.to_string(),
            row.threads.to_string(),
            row.spp.to_string(),
            row.wall_seconds.to_string(),
            row.cpu_seconds.to_string(),
            row.paths_per_second.to_string(),
            row.lookups_per_path.to_string(),
            row.lost.to_string(),
        ];
        for i in [&row.relmse, &row.efficiency, &row.lookups_to_unit_error, &row.speedup] {
            fields.extend([i.mean, i.lo, i.hi].map(|x| x.to_string()));
        }
        fields.extend([row.heavy_tailed.to_string(), row.reference.clone()]);
        writer.write_record(&fields)?;
    }
    let bytes = writer.into_inner().map_err(|e| e.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
