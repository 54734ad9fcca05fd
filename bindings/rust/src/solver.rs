//! Solver: sites that come and go on a surface, and the field through them.
use crate::core::{check, count_of, figures, handle_of, object, of_length, options, plain, start, start_of, Progress, Real, TryClone};
use crate::{raw, Error, Result, Surface};

options!(
    /// How a solver is made. Zero is the default of every option.
    SolverOptions: hf_solver_desc {
        /// `HF_FIELD_*`
        field_kind: i32,
        /// `HF_ENGINE_*`
        engine: i32,
        /// numbers at each vertex; 0 = 1
        channel_count: u32,
        /// more sites are refused; 0 = no limit
        site_limit: u32,
        /// weight of a site for the engines with penalties; 0 = the default
        penalty: f64,
    }
);

object!(
    /// Sites on a surface and their field.
    Solver: hf_solver, hf_solver_destroy { vertex_count: usize, channel_count: usize }
);

/// Places of sites, and what they hold. Set `vertices`, or `triangles` with `barycentrics`, or `corners` with
/// `barycentrics`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sites<'a> {
    /// one vertex a site
    pub vertices: Option<&'a [u32]>,
    /// one triangle a site
    pub triangles: Option<&'a [u32]>,
    /// three vertices a site
    pub corners: Option<&'a [u32]>,
    /// three numbers of sum 1 a site
    pub barycentrics: Option<&'a [f64]>,
    /// `channel_count` numbers a site; `None`: 0
    pub values: Option<&'a [f64]>,
    /// stiffness of soft sites; `None` or 0: hard
    pub stiffness: Option<&'a [f64]>,
    /// radius of the disc around each site; `None` or 0: the place alone
    pub radii: Option<&'a [f64]>,
}

impl Sites<'_> {
    fn desc(&self, channels: usize) -> Result<raw::hf_sites_desc> {
        let count = match (self.vertices, self.triangles, self.corners) {
            (Some(list), ..) | (None, Some(list), _) => list.len(),
            (None, None, Some(list)) => list.len() / 3,
            (None, None, None) => 1, // the library names what is missing
        };
        for (list, name) in [(self.vertices, "vertices"), (self.triangles, "triangles")] {
            list.map_or(Ok(()), |list| of_length(list, name, count))?;
        }
        self.corners.map_or(Ok(()), |list| of_length(list, "corners", 3 * count))?;
        for (list, name, width) in [
            (self.barycentrics, "barycentrics", 3),
            (self.values, "values", channels),
            (self.stiffness, "stiffness", 1),
            (self.radii, "radii", 1),
        ] {
            list.map_or(Ok(()), |list| of_length(list, name, width * count))?;
        }
        Ok(raw::hf_sites_desc {
            site_count: count_of(count, "sites")?,
            vertices: start_of(self.vertices),
            triangles: start_of(self.triangles),
            corners: start_of(self.corners),
            barycentrics: start_of(self.barycentrics),
            values: start_of(self.values),
            stiffness: start_of(self.stiffness),
            radii: start_of(self.radii),
            ..Default::default()
        })
    }
}

/// Several changes at once: all happen, or none. Sites are removed first, then moved, set and added.
#[derive(Clone, Copy, Debug, Default)]
pub struct Edit<'a> {
    /// numbers of sites
    pub remove: &'a [u32],
    /// numbers of sites
    pub moved: &'a [u32],
    /// their new places
    pub to: Option<Sites<'a>>,
    /// numbers of sites
    pub set: &'a [u32],
    /// their new values
    pub set_values: &'a [f64],
    /// new sites
    pub add: Option<Sites<'a>>,
}

impl Solver {
    /// A solver without sites.
    pub fn new(surface: &Surface, options: &SolverOptions) -> Result<Self> {
        Self::with_progress(surface, options, None)
    }

    /// As [`Solver::new`], followed through a progress object.
    pub fn with_progress(surface: &Surface, options: &SolverOptions, progress: Option<&Progress>) -> Result<Self> {
        let mut desc = raw::hf_solver_desc::default();
        options.fill(&mut desc);
        desc.progress = handle_of(progress);
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handles are valid and `desc` is whole.
        check(unsafe { raw::hf_create(surface.handle, &desc, &mut handle) })?;
        Ok(Solver { handle, vertex_count: surface.vertex_count, channel_count: desc.channel_count.max(1) as usize })
    }

    /// A copy with its own sites, on the same factor.
    pub fn try_clone(&self) -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_solver_clone(self.handle, &mut handle) })?;
        Ok(Solver { handle, vertex_count: self.vertex_count, channel_count: self.channel_count })
    }

    figures! {
        /// What the solver was made with.
        info => hf_solver_get_info -> hf_solver_info;
        /// What its edits and solves cost.
        statistics => hf_solver_get_statistics -> hf_solver_statistics;
    }

    plain! {
        /// Moves sites into the factor, when many edits are to follow.
        prepare_rebase => hf_solver_prepare_rebase;
        /// Frees the single-precision factor of the previews.
        release_preview => hf_solver_release_preview;
    }

    /// Sites now.
    pub fn site_count(&self) -> u32 {
        // SAFETY: the handle is valid.
        unsafe { raw::hf_solver_get_site_count(self.handle) }
    }

    /// Adds sites and returns their numbers.
    pub fn add_sites(&mut self, sites: &Sites) -> Result<Vec<u32>> {
        let desc = sites.desc(self.channel_count)?;
        let mut out = vec![0; desc.site_count as usize];
        // SAFETY: `desc` checked every length; `out` has one entry a site.
        check(unsafe { raw::hf_add_sites(self.handle, &desc, out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// Adds one hard site at a vertex. `values` has one number a channel; `None`: 0.
    pub fn add_site(&mut self, vertex: u32, values: Option<&[f64]>) -> Result<u32> {
        values.map_or(Ok(()), |values| of_length(values, "values", self.channel_count))?;
        let mut site = 0;
        // SAFETY: `values` is null or one number a channel.
        check(unsafe { raw::hf_solver_add_site(self.handle, vertex, start_of(values), &mut site) })?;
        Ok(site)
    }

    /// Removes sites by their numbers.
    pub fn remove_sites(&mut self, sites: &[u32]) -> Result<()> {
        let count = count_of(sites.len(), "sites")?;
        // SAFETY: `sites` has `count` entries.
        check(unsafe { raw::hf_remove_sites(self.handle, count, start(sites)) })
    }

    /// Moves sites to other places. They keep their numbers and values.
    pub fn move_sites(&mut self, sites: &[u32], to: &Sites) -> Result<()> {
        let desc = to.desc(self.channel_count)?;
        of_length(sites, "sites", desc.site_count as usize)?;
        // SAFETY: both have as many entries as `desc` says.
        check(unsafe { raw::hf_solver_move_sites(self.handle, desc.site_count, start(sites), &desc) })
    }

    /// Gives sites other values, one number a channel.
    pub fn set_values(&mut self, sites: &[u32], values: &[f64]) -> Result<()> {
        of_length(values, "values", sites.len() * self.channel_count)?;
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_solver_set_values(self.handle, count_of(sites.len(), "sites")?, start(sites), start(values)) })
    }

    /// Carries out one edit and returns the numbers of the new sites.
    pub fn edit_sites(&mut self, edit: &Edit) -> Result<Vec<u32>> {
        of_length(edit.set_values, "set_values", edit.set.len() * self.channel_count)?;
        let to = edit.to.map(|to| to.desc(self.channel_count)).transpose()?;
        let add = edit.add.map(|add| add.desc(self.channel_count)).transpose()?;
        if edit.moved.len() != to.map_or(0, |to| to.site_count as usize) {
            return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, "`to` must hold a place for each of `moved`"));
        }
        let desc = raw::hf_edit_desc {
            remove_count: count_of(edit.remove.len(), "remove")?,
            remove_sites: start(edit.remove),
            move_count: count_of(edit.moved.len(), "moved")?,
            move_sites: start(edit.moved),
            move_to: to.as_ref().map_or(std::ptr::null(), |to| to),
            set_count: count_of(edit.set.len(), "set")?,
            set_sites: start(edit.set),
            set_values: start(edit.set_values),
            add: add.as_ref().map_or(std::ptr::null(), |add| add),
            ..Default::default()
        };
        let mut out = vec![0; add.map_or(0, |add| add.site_count as usize)];
        // SAFETY: all lengths are checked; `out` has one entry a new site.
        check(unsafe { raw::hf_solver_edit_sites(self.handle, &desc, out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// The field: one number a channel at each vertex.
    pub fn solve(&self) -> Result<Vec<f64>> {
        let mut out = vec![0.0; self.vertex_count * self.channel_count];
        self.solve_into(&mut out)?;
        Ok(out)
    }

    /// Writes the field into a slice of yours and allocates nothing. Returns what no site reaches.
    pub fn solve_into<P: Real>(&self, out: &mut [P]) -> Result<raw::hf_solve_info> {
        of_length(out, "out", self.vertex_count * self.channel_count)?;
        let (single, double) = P::both_mut(out.as_mut_ptr());
        let mut info = raw::hf_solve_info::default();
        // SAFETY: `out` has room for the whole field; one of the pointers is null and not used.
        check(unsafe {
            if single.is_null() {
                raw::hf_solver_solve_f64(self.handle, double, 0, &mut info)
            } else {
                raw::hf_solve(self.handle, single, 0, &mut info)
            }
        })?;
        Ok(info)
    }

    /// The field from single-precision numbers, made better `correction_count` times.
    pub fn solve_preview(&self, correction_count: u32) -> Result<Vec<f64>> {
        let mut out = vec![0.0; self.vertex_count * self.channel_count];
        // SAFETY: `out` has room for the whole field.
        let null = std::ptr::null_mut();
        check(unsafe { raw::hf_solver_solve_preview_f64(self.handle, out.as_mut_ptr(), 0, correction_count, null) })?;
        Ok(out)
    }

    /// The field at some vertices.
    pub fn solve_at(&self, vertices: &[u32]) -> Result<Vec<f64>> {
        let mut out = vec![0.0; vertices.len() * self.channel_count];
        let count = count_of(vertices.len(), "vertices")?;
        // SAFETY: `out` has room for one row a vertex.
        check(unsafe { raw::hf_solver_solve_at(self.handle, count, start(vertices), out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// Measures the field on its own equations. Fails if an error exceeds the tolerance; 0 is the default.
    pub fn certify(&self, tolerance: f64) -> Result<raw::hf_certificate> {
        let mut certificate = raw::hf_certificate { tolerance, ..Default::default() };
        // SAFETY: the struct is whole.
        check(unsafe { raw::hf_solver_certify(self.handle, &mut certificate) })?;
        Ok(certificate)
    }
}

impl TryClone for Solver {
    fn try_clone(&self) -> Result<Self> {
        Solver::try_clone(self)
    }
}
