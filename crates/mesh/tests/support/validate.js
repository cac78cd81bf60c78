// Runs the Khronos glTF validator over the files named; prints every error and warning.
const validator = require('gltf-validator');
const fs = require('fs');

(async () => {
    let found = 0;
    for (const file of process.argv.slice(2)) {
        const bytes = new Uint8Array(fs.readFileSync(file));
        const report = await validator.validateBytes(bytes, { maxIssues: 50 });
        for (const issue of report.issues.messages.filter(m => m.severity < 2)) {
            console.log(`${file}: ${issue.code} ${issue.message} ${issue.pointer || ''}`);
            found += 1;
        }
    }
    process.exit(found === 0 ? 0 : 1);
})();
